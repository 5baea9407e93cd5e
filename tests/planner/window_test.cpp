#include <gtest/gtest.h>

#include <random>

#include "model/ball_flight.h"
#include "planner/rest_quartic.h"
#include "planner/window_cost.h"
#include "planner/window_starts.h"
#include "tests/planner/default_throw.h"

// Release windows: the hand's path in them, and the throws through them.
namespace fastball::planner {
namespace {

class Window : public testing::Test {
 protected:
  WindowProblem problem(double length) const {
    WindowProblem result;
    result.task = {&arm_, example_.config.hand.p_HBall, example_.experiment.target.p_WTarget,
                   example_.config.ball.dragPerMetre(), example_.config.arm.gravity};
    result.hand = &hand_;
    result.settings = example_.config.swing;
    result.errors = example_.config.robust.errors;
    result.limit_factor = example_.config.robust.limit_share;
    result.length = length;
    return result;
  }
  /// Where a ball that leaves the hand in `sample` lands.
  Eigen::Vector2d landing(const model::ArmMotion& sample) const {
    const Eigen::Vector3d& p_TBall = example_.config.hand.p_HBall;
    const model::BallState ball{arm_.p_WPoint(sample.q, p_TBall),
                                arm_.pointJacobian(sample.q, p_TBall) * sample.qd};
    return model::land(ball, example_.experiment.target, example_.config.ball.dragPerMetre(),
                       example_.config.arm.gravity)
        .value()
        .landing;
  }

  DefaultThrow example_;
  model::Arm arm_{example_.config.arm, example_.config.hand.payload};
  model::Hand hand_{example_.config.hand};
  /// A throw that uses every variable.
  WindowThrow some_ = windowStarts(0, 0.04).front();
};

TEST_F(Window, BallThatLeavesAtAnyMomentLandsAtTheSamePlace) {
  WindowMotion motion;
  ASSERT_TRUE(windowMotion(problem(0.04).task, some_.window, 8, motion));
  ASSERT_GT(motion.residual, 10) << "this window is not a free flight";
  for (const model::ArmMotion& sample : motion.samples)
    EXPECT_LT(landing(sample).norm(), 1e-4);
}

TEST_F(Window, WithoutPaceItIsTheFreeFlight) {
  some_.window.pace.setZero();
  const WindowTask task = problem(0.04).task;
  WindowMotion motion;
  ASSERT_TRUE(windowMotion(task, some_.window, 8, motion));
  EXPECT_EQ(motion.residual, 0);
  const model::BallState free =
      model::fly(motion.ball.front(), 0.04, task.drag_per_metre, task.gravity);
  EXPECT_LT((free.p_WBall - motion.ball.back().p_WBall).norm(), 1e-9);
  for (const model::ArmMotion& sample : motion.samples) {
    const Eigen::Vector3d v = arm_.pointJacobian(sample.q, task.p_TBall) * sample.qd;
    const Eigen::Vector3d a = arm_.pointAcceleration(sample.q, sample.qd, sample.qdd, task.p_TBall);
    EXPECT_LT((a - model::flightAcceleration(v, task.drag_per_metre, task.gravity)).norm(), 1e-9);
  }
}

TEST_F(Window, JointsFollowThePathAndItsDerivatives) {
  const WindowTask task = problem(0.04).task;
  WindowMotion motion;
  const int steps = 40;
  ASSERT_TRUE(windowMotion(task, some_.window, steps, motion));
  const double h = 0.04 / steps;
  for (int k = 1; k < steps; ++k) {
    const model::ArmMotion &before = motion.samples[k - 1], &at = motion.samples[k],
                           &after = motion.samples[k + 1];
    EXPECT_LT((arm_.p_WPoint(at.q, task.p_TBall) - motion.ball[k].p_WBall).norm(), 1e-11);
    EXPECT_LT(((after.q - before.q) / (2 * h) - at.qd).norm(), 2e-3);
    EXPECT_LT(((after.qd - before.qd) / (2 * h) - at.qdd).norm(), 0.2);
  }
}

TEST_F(Window, SaysWhenTheArmCannotFollow) {
  WindowMotion motion;
  ReleaseWindow straight = some_.window;
  straight.q_start = {0, 1, 0, 0};  // nearly straight: joint 4 cannot move the ball outwards
  straight.q_start[3] = std::atan2(0.09, 1.0);
  EXPECT_FALSE(windowMotion(problem(0.04).task, straight, 8, motion));
  ReleaseWindow late = some_.window;
  late.time_to_go = 0.02;  // shorter than the window
  EXPECT_FALSE(windowMotion(problem(0.04).task, late, 8, motion));
  late.time_to_go = std::nan("");
  EXPECT_FALSE(windowMotion(problem(0.04).task, late, 8, motion));
}

/// Largest difference between the slopes of a window and central differences, relative to the size of the row.
double slopeError(const WindowTask& task, const ReleaseWindow& window) {
  constexpr int kSteps = 4;
  WindowMotion motion;
  WindowSlopes slopes;
  EXPECT_TRUE(windowMotion(task, window, kSteps, motion, &slopes));
  WindowThrow x;
  x.window = window;
  double worst = 0;
  for (int i = 0; i < kWindowParameters; ++i) {
    const double step = 1e-4 * windowBounds().scale[i];
    const auto shifted = [&](double by) {
      WindowVector v = toVector(x);
      v[i] += by;
      WindowMotion at;
      EXPECT_TRUE(windowMotion(task, fromVector(v, window.length).window, kSteps, at));
      return at;
    };
    const WindowMotion low = shifted(-step), high = shifted(step);
    for (int k = 0; k <= kSteps; ++k) {
      Eigen::Matrix<double, 12, 1> difference;
      difference << high.samples[k].q - low.samples[k].q, high.samples[k].qd - low.samples[k].qd,
          high.samples[k].qdd - low.samples[k].qdd;
      difference /= 2 * step;
      const Eigen::Matrix<double, 12, 1> error = slopes.samples[k].col(i) - difference;
      for (int row = 0; row < 12; ++row)
        worst = std::max(worst, std::abs(error[row]) / (1 + difference.cwiseAbs().maxCoeff()));
    }
  }
  return worst;
}

TEST_F(Window, SlopesAreThoseOfDifferences) {
  const WindowTask task = problem(0.04).task;
  // The slope of dv/dT leaves out what drag does to it: a tenth of the slope of the accelerations.
  EXPECT_LT(slopeError(task, some_.window), 0.1);
  some_.window.pace = {1e-9, -1e-9};
  EXPECT_LT(slopeError(task, some_.window), 1e-4);
}

TEST_F(Window, SidesBeginInTheWindowAndEndAtRest) {
  WindowMotion motion;
  ASSERT_TRUE(windowMotion(problem(0.04).task, some_.window, 8, motion));
  const model::ArmMotion edge = motionBefore(some_, motion.samples.front(), 0);
  EXPECT_LT((edge.q - motion.samples.front().q).norm(), 1e-15);
  EXPECT_LT((edge.qd - motion.samples.front().qd).norm(), 1e-15);
  EXPECT_LT((edge.qdd - motion.samples.front().qdd).norm(), 1e-12);
  const model::ArmMotion ramp_end = motionBefore(some_, motion.samples.front(), -kWindowRamp);
  EXPECT_LT((ramp_end.qdd - some_.qdd_before).norm(), 1e-12);
  for (const double t : {-kWindowRamp - 0.71, -2.0}) {
    const model::ArmMotion rest = motionBefore(some_, motion.samples.front(), t);
    EXPECT_LT(rest.qd.norm() + rest.qdd.norm(), 1e-12);
  }
  const model::ArmMotion rest = motionAfter(some_, motion.samples.back(), 0.7);
  EXPECT_LT(rest.qd.norm() + rest.qdd.norm(), 1e-12);
}

TEST_F(Window, SidesAreContinuousUpToTheAcceleration) {
  WindowMotion motion;
  ASSERT_TRUE(windowMotion(problem(0.04).task, some_.window, 8, motion));
  const double h = 1e-5;
  for (double t = 0.001; t < 0.7; t += 0.0093) {
    const model::ArmMotion low = motionBefore(some_, motion.samples.front(), -t - h),
                           at = motionBefore(some_, motion.samples.front(), -t),
                           high = motionBefore(some_, motion.samples.front(), -t + h);
    EXPECT_LT(((high.q - low.q) / (2 * h) - at.qd).norm(), 1e-5) << t;
    EXPECT_LT(((high.qd - low.qd) / (2 * h) - at.qdd).norm(), 0.1) << t;
  }
}

TEST(RestQuartic, SlopesAreThoseOfDifferences) {
  const model::BaseValue from{0.3, 2.5, -20};
  const double T = 0.35, h = 1e-6;
  for (const double t : {0.0, 1e-6, 0.1, 0.3499, 0.4}) {
    const RestQuartic r = restQuartic(from, T, t);
    const auto check = [&](const model::BaseValue& slope, const RestQuartic& low,
                           const RestQuartic& high) {
      EXPECT_NEAR(slope.q, (high.value.q - low.value.q) / (2 * h), 1e-6);
      EXPECT_NEAR(slope.qd, (high.value.qd - low.value.qd) / (2 * h), 1e-5);
      EXPECT_NEAR(slope.qdd, (high.value.qdd - low.value.qdd) / (2 * h), 1e-3);
    };
    check(r.by_speed, restQuartic({from.q, from.qd - h, from.qdd}, T, t),
          restQuartic({from.q, from.qd + h, from.qdd}, T, t));
    check(r.by_acceleration, restQuartic({from.q, from.qd, from.qdd - h}, T, t),
          restQuartic({from.q, from.qd, from.qdd + h}, T, t));
    check(r.by_duration, restQuartic(from, T - h, t), restQuartic(from, T + h, t));
  }
}

TEST_F(Window, CostGradientIsThatOfDifferences) {
  WindowProblem limited = problem(0.04);
  limited.limit_factor = 0.7;  // many limits are exceeded: every kind of row counts
  limited.wanted_speed = 8;    // none is as fast
  WindowCost cost(limited);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const WindowVector& scale = windowBounds().scale;
  for (int trial = 0; trial < 20; ++trial) {
    WindowVector x = toVector(some_);
    for (int i = 0; i < kWindowVariables; ++i)
      x[i] += 0.03 * scale[i] * normal(random);
    // A small pace: the slope of dv/dT leaves out what drag does to it.
    x.segment<2>(8) *= 0.01;
    const WindowVector gradient = 2 * cost.at(x, true).half_gradient;
    for (int i = 0; i < kWindowVariables; ++i) {
      WindowVector low = x, high = x;
      low[i] -= 1e-5 * scale[i];
      high[i] += 1e-5 * scale[i];
      const double difference = (cost.at(high, false).value - cost.at(low, false).value) / 2e-5;
      EXPECT_NEAR(gradient[i], difference, 2e-3 * gradient.norm()) << "variable " << i;
    }
  }
}

TEST_F(Window, MirroredThrowLandsMirrored) {
  const WindowTask task = problem(0.04).task;
  WindowMotion right, left;
  ASSERT_TRUE(windowMotion(task, some_.window, 8, right));
  ASSERT_TRUE(windowMotion(task, mirrored(some_).window, 8, left));
  EXPECT_NEAR(right.ball.front().p_WBall.y(), -left.ball.front().p_WBall.y(), 1e-12);
  EXPECT_NEAR(right.ball.front().v_WBall.z(), left.ball.front().v_WBall.z(), 1e-9);
}

}  // namespace
}  // namespace fastball::planner
