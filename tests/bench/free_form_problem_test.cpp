// Throws as curves: their basis, and gradients by their variables.

#include "bench/free_form_problem.h"

#include <gtest/gtest.h>

#include "tests/bench/free_throws.h"

namespace fastball::bench {
namespace {

constexpr int kControlPoints = 9;

TEST(SplineBasis, RestsAtBothEnds) {
  for (const int count : {4, 12, 40}) {
    const SplineBasis basis(count);
    EXPECT_EQ(basis.size(), count);
    for (const double end : {0.0, 1.0})
      EXPECT_LT(basis.at(end).row(1).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(SplineBasis, HasItsDerivatives) {
  const SplineBasis basis(kControlPoints);
  constexpr double kStep = 1e-6;
  for (const double s : {0.01, 0.3, 0.5, 0.77, 0.99}) {
    const Eigen::MatrixXd expected = (basis.at(s + kStep) - basis.at(s - kStep)) / (2 * kStep);
    EXPECT_LT((basis.at(s).bottomRows<2>() - expected.topRows<2>()).cwiseAbs().maxCoeff(),
              1e-7 * (1 + expected.cwiseAbs().maxCoeff()));
  }
}

TEST(SplineBasis, FitsCurvesOfItsOwn) {
  const SplineBasis basis(kControlPoints);
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(50, 0, 1);
  // A quartic with zero slope at both ends, and a constant.
  const auto curve = [](double at) { return 2 + at * at * (1 - at) * (1 - at); };
  const Eigen::VectorXd x = basis.fit(s, s.unaryExpr(curve));
  for (const double at : {0.0, 0.123, 0.5, 1.0})
    EXPECT_NEAR(basis.at(at).row(0).dot(x), curve(at), 1e-9);
}

TEST(SplineBasis, RefusesTooFewControlPoints) {
  EXPECT_THROW(SplineBasis(3), std::invalid_argument);
}

class FreeFormProblems : public testing::TestWithParam<bool> {
 protected:
  FreeFormProblem problem() const {
    CeilingOptions options;
    options.hold_shoulder = GetParam();
    options.across_forearm = true;
    return FreeFormProblem(throws_.task(options), kControlPoints);
  }
  Eigen::VectorXd variables(const FreeFormProblem& problem) {
    Eigen::VectorXd x = throws_.uniform(problem.size(), -0.5, 0.5);
    x.tail<3>() << throws_.uniform(0.4, 1), throws_.uniform(0.3, 0.7), throws_.uniform(0.2, 1);
    return x;
  }
  FreeThrows throws_;
};

TEST_P(FreeFormProblems, GradientsOfLimits) {
  const FreeFormProblem problem = this->problem();
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd x = variables(problem);
    const double s = throws_.uniform(0, 1);
    const model::ArmMotion motion = problem.motion(x, s);
    const LimitSlopes slopes = limitSlopes(problem.task(), motion);
    Eigen::MatrixXd derivative(LimitRows::kCount, problem.size());
    Eigen::VectorXd row(problem.size());
    for (int k = 0; k < LimitRows::kCount; ++k) {
      problem.gradient(problem.basis().at(s), motion, x[problem.durationIndex()],
                       slopes.by_q.row(k), slopes.by_qd.row(k), slopes.by_qdd.row(k), row);
      derivative.row(k) = row.transpose();
    }
    expectSlope(
        [&](const Eigen::VectorXd& at) {
          return Eigen::VectorXd(limitSlopes(problem.task(), problem.motion(at, s)).rows.value);
        },
        x, derivative, 1e-6);
  }
}

TEST_P(FreeFormProblems, GradientsOfTheRelease) {
  const FreeFormProblem problem = this->problem();
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd x = variables(problem);
    const ReleaseRows rows = problem.release(x);
    Eigen::MatrixXd slopes(6, ReleaseRows::kBy);
    slopes << rows.equal_slope, rows.speed_slope, rows.grazing_slope;
    expectSlope(
        [&](const Eigen::VectorXd& at) {
          const ReleaseRows there = problem.release(at);
          Eigen::VectorXd values(6);
          values << there.equal, there.speed, there.grazing;
          return values;
        },
        x, problem.releaseGradient(x, slopes), 1e-6);
  }
}

TEST_P(FreeFormProblems, MotionsAreTheirOwnDerivatives) {
  const FreeFormProblem problem = this->problem();
  const Eigen::VectorXd x = variables(problem);
  constexpr double kStep = 1e-6;
  const double per_second = 1 / (2 * kStep * x[problem.durationIndex()]);
  for (const double s : {0.1, 0.5, 0.8}) {
    const model::ArmMotion before = problem.motion(x, s - kStep),
                           after = problem.motion(x, s + kStep), now = problem.motion(x, s);
    EXPECT_LT(((after.q - before.q) * per_second - now.qd).norm(), 1e-6 * (1 + now.qd.norm()));
    EXPECT_LT(((after.qd - before.qd) * per_second - now.qdd).norm(), 1e-6 * (1 + now.qdd.norm()));
  }
}

TEST(FreeFormProblemTest, KeepsAHeldThrowWhenItFreesTheShoulder) {
  FreeThrows throws;
  CeilingOptions options;
  const FreeFormProblem free(throws.task(options), kControlPoints);
  options.hold_shoulder = true;
  const FreeFormProblem held(throws.task(options), kControlPoints);
  Eigen::VectorXd x = throws.uniform(held.size(), -1, 1);
  x.tail<3>() << 0.7, 0.6, 0.5;
  const Eigen::VectorXd freed = withFreeShoulder(held, x, free);
  for (const double s : {0.0, 0.3, 1.0}) {
    const model::ArmMotion a = held.motion(x, s), b = free.motion(freed, s);
    EXPECT_LT((a.q - b.q).norm() + (a.qd - b.qd).norm() + (a.qdd - b.qdd).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(ShoulderFreeAndHeld, FreeFormProblems, testing::Bool());

}  // namespace
}  // namespace fastball::bench
