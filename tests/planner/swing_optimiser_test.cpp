// Solutions are optima, and hold their limits between the samples too.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "tests/planner/swing_tasks.h"

namespace fastball::planner {
namespace {

constexpr int kEvaluations = 200;

/// What is left of `vector` after the best sum of `rows`, all but the first `signless` with factors >= 0.
double distanceFromCone(const SwingVector& vector, std::vector<SwingVector> rows, int signless) {
  while (true) {
    Eigen::MatrixXd A(kSwingVariables, rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      A.col(i) = rows[i];
    const Eigen::VectorXd factors = A.completeOrthogonalDecomposition().solve(vector);
    if (factors.size() == signless)
      return (vector - A * factors).norm();
    Eigen::Index lowest = 0;
    const double factor = factors.tail(factors.size() - signless).minCoeff(&lowest);
    if (factor >= 0)
      return (vector - A * factors).norm();
    rows.erase(rows.begin() + signless + lowest);
  }
}

struct Wanted {
  Shoulder shoulder;
  SwingGoal goal;
};

class OptimisedSwing : public testing::TestWithParam<Wanted> {
 protected:
  static double worth(const SwingTask& task, const SwingSolution& s) {
    return task.goal == SwingGoal::kFastest ? s.release_speed : -s.x[kFlightTime];
  }
  SwingTask task() const {
    SwingTask task = example_.task(GetParam().shoulder);
    task.goal = GetParam().goal;
    return task;
  }
  /// The best solution from the stored starts.
  SwingSolution best(const SwingTask& task) const {
    std::optional<SwingSolution> best;
    for (const Start& start : storedStarts(task.settings.shoulder, 0)) {
      const SwingSolution s = optimiseSwing(task, start.x, start.elbow_sign, kEvaluations);
      if (s.violation < 1e-4 && (!best || worth(task, s) > worth(task, *best)))
        best = s;
    }
    return best.value();
  }
  DefaultSwing example_;
};

INSTANTIATE_TEST_SUITE_P(With,
                         OptimisedSwing,
                         testing::Values(Wanted{Shoulder::kHeld, SwingGoal::kFastest},
                                         Wanted{Shoulder::kFree, SwingGoal::kFastest},
                                         Wanted{Shoulder::kFree, SwingGoal::kShortestFlight}),
                         [](const auto& test) {
                           if (test.param.goal == SwingGoal::kShortestFlight)
                             return "TheShortestFlight";
                           return test.param.shoulder == Shoulder::kHeld ? "ShoulderHeld"
                                                                         : "ShoulderFree";
                         });

TEST_P(OptimisedSwing, HoldsItsLimitsAtEveryTime) {
  const SwingTask task = this->task();
  const SwingSolution solution = best(task);
  if (task.goal == SwingGoal::kFastest)
    ASSERT_GT(solution.release_speed, 5.9);
  else
    ASSERT_LT(solution.x[kFlightTime], 0.6);
  const SwingLimits limits(task, solution.elbow_sign);
  const HeldBall held(example_.hand, solution.x[kWristRoll], solution.x[kWristFlexion]);
  const SwingCurve curve(solution.x, solution.elbow_sign);
  const FollowThrough& follow = task.settings.follow;
  model::ArmMotion at = curve.at(curve.begin());
  double highest = -1;
  for (double t = curve.begin(); t <= follow.delay; t += 1e-4) {
    at = curve.at(t, at.q[2]);
    highest = std::max(highest, limits.at(at, held.p_TBall).maxCoeff());
  }
  const model::ArmMotion from = curve.at(follow.delay, at.q[2]);
  for (double t = 0; t <= follow.brake_time.maxCoeff(); t += 1e-4) {
    SwingLimits::Values values = limits.at(follow.braked(from, t), held.p_TBall);
    values[kElbow] = -1;
    highest = std::max(highest, values.maxCoeff());
  }
  EXPECT_LT(highest, 1e-4);
  EXPECT_GT(highest, -1e-4) << "none of the limits is used";
}

TEST_P(OptimisedSwing, FulfilsTheConditionsOfKarushKuhnAndTucker) {
  const SwingTask task = this->task();
  const SwingSolution solution = best(task);
  const SwingProblem problem(task, solution.elbow_sign);
  const SwingProblem::Values values = problem.evaluate(solution.x);
  const SwingProblem::Gradients gradients = problem.gradients(solution.x, values);
  const SwingVector better = task.goal == SwingGoal::kFastest
                                 ? SwingVector(gradients.release_speed)
                                 : SwingVector(-SwingVector::Unit(kFlightTime));
  // At an optimum the gradient of what is wanted is a sum of those of the active constraints, inequalities with factors >= 0.
  std::vector<SwingVector> active;
  for (int i = 0; i < problem.equalityCount(); ++i)
    active.push_back(gradients.equalities.row(i));
  for (int i = 0; i < problem.inequalityCount(); ++i) {
    if (values.inequalities[i] > -1e-4)
      active.push_back(gradients.inequalities.row(i));
  }
  for (int k = 0; k < kSwingVariables; ++k) {
    if (solution.x[k] < problem.lower()[k] + 1e-9)
      active.push_back(-SwingVector::Unit(k));
    if (solution.x[k] > problem.upper()[k] - 1e-9)
      active.push_back(SwingVector::Unit(k));
  }
  EXPECT_GE(better.norm(), 1);
  EXPECT_LT(distanceFromCone(better, active, problem.equalityCount()), 0.02 * better.norm());
}

TEST_P(OptimisedSwing, IsFoundAgainFromANeighbour) {
  const SwingTask task = this->task();
  const SwingSolution solution = best(task);
  for (const Eigen::Vector3d& shift :
       {Eigen::Vector3d(0.1, 0, 0), Eigen::Vector3d(0, -0.1, 0), Eigen::Vector3d(0, 0, 0.1)}) {
    SwingTask near = task;
    near.target.p_WTarget += shift;
    const SwingSolution corrected = correctSwing(near, solution, 10);
    EXPECT_LT(corrected.violation, 1e-3) << shift.transpose();
    const SwingSolution optimised =
        optimiseSwing(near, solution.x, solution.elbow_sign, kEvaluations);
    EXPECT_LT(optimised.violation, 1e-4) << shift.transpose();
    EXPECT_GE(worth(near, optimised), worth(near, corrected) - 1e-3) << shift.transpose();
  }
}

TEST_P(OptimisedSwing, SurvivesAnyStart) {
  const SwingTask task = this->task();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double number : {0.0, 1e-300, 1e300, inf, std::nan("")}) {
    const SwingSolution solution =
        optimiseSwing(task, SwingVector::Constant(number), 1, kEvaluations);
    EXPECT_TRUE(solution.violation >= 0) << number;
    EXPECT_TRUE(solution.violation > 1e-4 || solution.x.allFinite()) << number;
  }
}

}  // namespace
}  // namespace fastball::planner
