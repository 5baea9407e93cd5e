// Every derivative that the optimiser is given, against central differences.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/scaled_swing.h"
#include "tests/planner/swing_tasks.h"

namespace fastball::planner {
namespace {

constexpr double kStep = 1e-6;

template <typename Function>
auto difference(const Function& f, const SwingVector& x, int variable) {
  const SwingVector step = kStep * SwingVector::Unit(variable);
  auto result = f(x + step);
  result -= f(SwingVector(x - step));
  result /= 2 * kStep;
  return result;
}

class Gradients : public testing::Test {
 protected:
  Eigen::Vector4d vector(double size) {
    std::uniform_real_distribution<double> number(-size, size);
    return Eigen::Vector4d::NullaryExpr([&] { return number(engine_); });
  }
  DefaultSwing example_;
  std::mt19937 engine_{5};
};

TEST_F(Gradients, OfTheArmsMotionByTheParameters) {
  for (const Start& start : randomSwings(20, 1)) {
    for (const double t : {-0.6, -0.3, -0.1, -0.01, 0.0, 0.04}) {
      const MotionGradient g{vector(1), vector(1), vector(1)};
      const auto number = [&](const SwingVector& x) {
        const model::ArmMotion at = SwingCurve(x, start.elbow_sign).at(t);
        return g.q.dot(at.q) + g.qd.dot(at.qd) + g.qdd.dot(at.qdd);
      };
      const SwingDerivatives d = SwingCurve(start.x, start.elbow_sign).derivativesAt(t);
      if (std::abs(d.motion().q[3]) < 0.2)
        continue;  // differences lose their meaning towards the straight elbow
      SwingVector gradient = SwingVector::Zero();
      d.pull(g, gradient);
      const double size = 10 + gradient.norm();
      for (int k = 0; k < kSwingVariables; ++k)
        EXPECT_NEAR(gradient[k], difference(number, start.x, k), 1e-5 * size) << k << " at " << t;
    }
  }
}

TEST_F(Gradients, OfTheLimits) {
  const SwingTask task = example_.task();
  const SwingLimits limits(task, 1);
  for (int i = 0; i < 50; ++i) {
    const double roll = vector(3)[0], flexion = vector(0.5)[0];
    const HeldBall held(example_.hand, roll, flexion);
    const model::ArmMotion at{vector(2), vector(5), vector(60)};
    const model::ArmMotion step{vector(1), vector(1), vector(1)};
    for (int k = 0; k < kSwingLimits; ++k) {
      const auto limit = static_cast<SwingLimit>(k);
      const auto value = [&](double h) {
        const HeldBall moved(example_.hand, roll + h, flexion - 0.5 * h);
        return limits.at(limit, {at.q + h * step.q, at.qd + h * step.qd, at.qdd + h * step.qdd},
                         moved.p_TBall);
      };
      EXPECT_EQ(limits.at(at, held.p_TBall)[k], value(0));
      const SwingLimits::Gradient g = limits.gradient(limit, at, held);
      EXPECT_NEAR(g.motion.q.dot(step.q) + g.motion.qd.dot(step.qd) + g.motion.qdd.dot(step.qdd) +
                      g.roll - 0.5 * g.flexion,
                  (value(kStep) - value(-kStep)) / (2 * kStep), 1e-5)
          << SwingLimits::name(limit);
    }
  }
}

TEST_F(Gradients, OfTheReleaseAndTheLanding) {
  const SwingTask task = example_.task();
  const ReleaseConditions conditions(task);
  for (const Start& start : randomSwings(20, 2)) {
    const auto values = [&](const SwingVector& x) {
      const ReleaseConditions::Values v =
          conditions.values(x, SwingCurve(x, start.elbow_sign).at(0));
      Eigen::Matrix<double, 7, 1> all;
      all << v.speed, v.hand_lead, v.equalities;
      return all;
    };
    const auto g =
        conditions.gradients(start.x, SwingCurve(start.x, start.elbow_sign).derivativesAt(0));
    for (int k = 0; k < kSwingVariables; ++k) {
      const auto expected = difference(values, start.x, k);
      Eigen::Matrix<double, 7, 1> column;
      column << g.speed[k], g.hand_lead[k], g.equalities.col(k);
      EXPECT_LT((column - expected).norm(), 1e-5 * (10 + expected.norm())) << k;
    }
  }
}

TEST_F(Gradients, OfEveryConstraintRow) {
  int checked = 0, skipped = 0;
  for (const Shoulder shoulder : {Shoulder::kHeld, Shoulder::kFree}) {
    const SwingTask task = example_.task(shoulder);
    for (const Start& start : randomSwings(12, 3)) {
      const SwingProblem problem(task, start.elbow_sign);
      const SwingProblem::Values at = problem.evaluate(start.x);
      const auto gradients = problem.gradients(start.x, at);
      for (int k = 0; k < kSwingVariables; ++k) {
        const SwingVector step = kStep * SwingVector::Unit(k);
        const auto high = problem.evaluate(start.x + step), low = problem.evaluate(start.x - step);
        for (int row = 0; row < static_cast<int>(problem.rows().size()); ++row) {
          // Peaks far below their limit have no gradient; of two peaks as high as each other either may be
          // followed; near the straight elbow differences have no meaning.
          if (at.inequalities[row] < -0.5 || at.inequalities[row] > 20)
            continue;
          const bool jumps = std::abs(high.peaks[row].time - low.peaks[row].time) > 1e-3;
          skipped += jumps;
          if (jumps)
            continue;
          const double expected = (high.inequalities[row] - low.inequalities[row]) / (2 * kStep);
          EXPECT_NEAR(gradients.inequalities(row, k), expected,
                      2e-3 * (1 + gradients.inequalities.row(row).norm()))
              << SwingLimits::name(problem.rows()[row].limit) << ", window "
              << problem.rows()[row].window << ", variable " << swingVariableNames()[k] << " value "
              << at.inequalities[row] << " t " << at.peaks[row].time;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 5000);
  EXPECT_LT(skipped, checked / 100);
}

TEST_F(Gradients, OfTheCoordinates) {
  for (const Start& start : randomSwings(20, 4)) {
    const SwingVector y = coordinatesOf(start.x);
    EXPECT_LT((parametersOf(y) - start.x).norm(), 1e-12);
    for (const int block : {kAlpha1, kAlpha3, kAlphaGamma}) {
      EXPECT_EQ(y[block], start.x[block] * start.x[block + 1]);
    }
    const SwingVector by_x = SwingVector::Random();
    const auto number = [&](const SwingVector& at) { return by_x.dot(parametersOf(at)); };
    const SwingVector by_y = CoordinateGradient(start.x)(by_x);
    for (int k = 0; k < kSwingVariables; ++k)
      EXPECT_NEAR(by_y[k], difference(number, y, k), 1e-6) << swingVariableNames()[k];
  }
}

TEST_F(Gradients, OfWhatTheOptimiserSees) {
  for (const Shoulder shoulder : {Shoulder::kHeld, Shoulder::kFree}) {
    const SwingTask task = example_.task(shoulder);
    for (const Start& start : storedStarts(shoulder, 0)) {
      const SwingProblem problem(task, start.elbow_sign);
      // Not where the flight gets one more step of integration.
      const SwingVector x = start.x + 0.013 * SwingVector::Unit(kFlightTime);
      ScaledSwing swing(problem, x), moved(problem, x);
      const std::vector<double> u = swing.start();
      const ScaledSwing::Values at = swing.values(u.data());
      const ScaledSwing::Gradients& g = swing.gradients(u.data());
      // Eq. (24), the wrist, the speed and the landing: the rows without a peak to be looked for.
      const auto rows = [](const ScaledSwing::Values& v) {
        Eigen::VectorXd all(6);
        all << v.inequalities.tail<2>(), v.release_speed, v.equalities;
        return all;
      };
      for (unsigned k = 0; k < swing.size(); ++k) {
        std::vector<double> high = u, low = u;
        high[k] += kStep;
        low[k] -= kStep;
        const Eigen::VectorXd expected =
            (rows(moved.values(high.data())) - rows(moved.values(low.data()))) / (2 * kStep);
        Eigen::VectorXd column(6);
        column << g.inequalities.col(k).tail<2>(), g.release_speed[k], g.equalities.col(k);
        EXPECT_LT((column - expected).norm(), 1e-5 * (1 + expected.norm())) << start.name << k;
      }
      EXPECT_TRUE(at.finite);
    }
  }
}

}  // namespace
}  // namespace fastball::planner
