#include "model/rolling_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/rolling_ball_3d.h"
#include "tests/model/hand_paths.h"

namespace fastball::model {
namespace {

/// Accelerates evenly without turning, in the fingers' directions [m/s^2]: along x', along y'.
SwingPath pushed(double along, double forward) {
  SwingPath path;
  path.push = {along, forward, 0};
  return path;
}

class Rolling : public testing::TestWithParam<bool> {
 protected:
  double inertiaRatio() const {
    const double h = fingers_.rollingHeight(ball_.radius);
    return ball_.inertia() / (ball_.mass * h * h);
  }
  BallParameters ball_ = exampleBall();
  FingerPair fingers_ = exampleFingers(GetParam());
  RollingTask task_;
};
INSTANTIATE_TEST_SUITE_P(On, Rolling, testing::Bool(), [](const auto& p) {
  return p.param ? "Groove" : "Plane";
});

TEST_P(Rolling, TakesFiveSeventhsOfTheDriveOrTheGroovesShare) {
  ball_.drag_coefficient = 0;
  task_.gravity = 0;
  task_.t_end = 0.05;
  const double share = 1 / (1 + inertiaRatio());
  EXPECT_NEAR(share, GetParam() ? 0.652 : 5.0 / 7, 1e-3);
  for (const double drive : {0.0, 1e-6, 5.0, -20.0}) {
    const RollingMotion motion = rollOnFingers(ball_, fingers_, pushed(-drive, 50), task_);
    EXPECT_FALSE(motion.released);
    EXPECT_LT(motion.t_slip, 0);
    for (const RollingSample& s : motion.samples) {
      EXPECT_NEAR(s.p_FBall.x(), share * drive * s.t * s.t / 2, 1e-9);
      EXPECT_NEAR(s.force_F.y(), ball_.mass * 50, 1e-9);
    }
  }
}

TEST_P(Rolling, SlidesWithWhatCoulombLeaves) {
  ball_.drag_coefficient = 0;
  ball_.friction = 0.1;
  task_.gravity = 0;
  task_.t_end = 0.05;
  const double drive = 40, forward = 20;  // rolling needs some 0.3 of the normal force
  const RollingMotion motion = rollOnFingers(ball_, fingers_, pushed(-drive, forward), task_);
  EXPECT_EQ(motion.t_slip, 0);
  const double cos_beta = fingers_.cosBeta(ball_.radius);
  const double a = drive - ball_.friction * forward / cos_beta;
  EXPECT_NEAR(motion.samples.back().p_FBall.x(), a * 0.05 * 0.05 / 2, 1e-9);
  const double h = fingers_.rollingHeight(ball_.radius);
  const double spin = -ball_.friction * ball_.mass * forward / cos_beta * h / ball_.inertia();
  EXPECT_NEAR(motion.w_WBall.z(), spin * 0.05, 1e-7);
}

// Eqs. (21) and (22) as derived, against Newton and Euler in the world, for any motion of the hand.
TEST_P(Rolling, IsNewtonsAndEulersInTheWorld) {
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    ball_.friction = 1e6;  // rolls until the last moment
    SwingPath path = randomSwing(random);
    if (!GetParam())
      path.roll.setZero(), path.R_W = exampleSwing().R_W, path.push.y() = 0;  // nothing along z'
    const RollingMotion eqs = rollOnFingers(ball_, fingers_, path, task_),
                        newton = rollOnFingers3d(ball_, fingers_, path, task_);
    ASSERT_TRUE(eqs.released && newton.released);
    EXPECT_GT(eqs.t_release, 0.02);
    EXPECT_NEAR(eqs.t_release, newton.t_release, 1e-8);
    for (std::size_t k = 0; k + 1 < eqs.samples.size(); ++k) {
      const RollingSample &a = eqs.samples[k], &b = newton.samples[k];
      EXPECT_NEAR(a.p_FBall.x(), b.p_FBall.x(), 1e-9);
      EXPECT_LT(b.p_FBall.tail<2>().norm(), 1e-9) << "Eq. (20)";
      EXPECT_LT((a.force_F - b.force_F).norm(), 1e-6) << "swing " << i << ", t = " << a.t;
    }
    EXPECT_LT((eqs.ball.v_WBall - newton.ball.v_WBall).norm(), 1e-6);
    EXPECT_LT((eqs.ball.p_WBall - newton.ball.p_WBall).norm(), 1e-7);
    EXPECT_LT((eqs.w_WBall - newton.w_WBall).norm(), 1e-4);
  }
}

TEST_P(Rolling, SlipsBeforeItLeavesAndLaterWithMoreFriction) {
  double slip_before = 0;
  const double rolled = [&] {
    ball_.friction = 1e9;
    return rollOnFingers(ball_, fingers_, exampleSwing(), task_).t_release;
  }();
  for (const double mu : {0.3, 0.5, 1.0, 2.0}) {
    ball_.friction = mu;
    const RollingMotion motion = rollOnFingers(ball_, fingers_, exampleSwing(), task_);
    ASSERT_TRUE(motion.released);
    EXPECT_GT(motion.t_slip, slip_before);
    EXPECT_LT(motion.t_slip, motion.t_release - 1e-3);
    EXPECT_GT(motion.t_release, rolled) << "without the pull of friction x' is larger";
    EXPECT_NEAR(motion.samples.back().force_F.y(), 0, 1e-9);
    slip_before = motion.t_slip;
  }
}

TEST_P(Rolling, FrictionStaysInItsConeAndOnlyTakesEnergy) {
  std::mt19937 random(9);
  std::uniform_real_distribution<> unit(0, 1);
  for (int i = 0; i < 100; ++i) {
    ball_.friction = i % 10 == 0 ? 0 : 1.5 * unit(random);
    const RollingMotion motion = rollOnFingers(ball_, fingers_, randomSwing(random), task_);
    const double cos_beta = fingers_.cosBeta(ball_.radius);
    ASSERT_TRUE(motion.ball.v_WBall.allFinite() && motion.w_WBall.allFinite());
    for (const RollingSample& s : motion.samples) {
      EXPECT_GE(s.force_F.y(), -1e-9);
      EXPECT_LE(std::abs(s.force_F.x()), ball_.friction * s.force_F.y() / cos_beta + 1e-9);
    }
  }
}

TEST_P(Rolling, LeavesAtOnceWhereTheHandDoesNotPush) {
  ball_.drag_coefficient = 0;
  task_.gravity = 0;
  EXPECT_EQ(rollOnFingers(ball_, fingers_, pushed(-10, 0), task_).t_release, 0);
  for (const double forward : {-1e-9, -50.0}) {
    for (const auto& roll : {rollOnFingers, rollOnFingers3d}) {
      const RollingMotion motion = roll(ball_, fingers_, pushed(-10, forward), task_);
      EXPECT_TRUE(motion.released);
      EXPECT_EQ(motion.t_release, 0);
      EXPECT_EQ(motion.ball.v_WBall.norm(), 0);
    }
  }
}

TEST_P(Rolling, ComesOffAtTheFingertips) {
  task_.fingertip = 0.005;
  for (const auto& roll : {rollOnFingers, rollOnFingers3d}) {
    const RollingMotion off = roll(ball_, fingers_, exampleSwing(), task_);
    EXPECT_TRUE(off.released && off.rolled_off);
    EXPECT_NEAR(off.samples.back().p_FBall.x(), 0.005, 1e-12);
    EXPECT_GT(off.samples.back().force_F.y(), 0.1);
    task_.fingertip = 1;
    EXPECT_FALSE(roll(ball_, fingers_, exampleSwing(), task_).rolled_off);
    task_.fingertip = 0.005;
  }
}

TEST_P(Rolling, RefusesWhatMakesNoSense) {
  const auto refused = [&](auto change) {
    BallParameters ball = ball_;
    RollingTask task = task_;
    change(ball, task);
    EXPECT_THROW(rollOnFingers(ball, fingers_, exampleSwing(), task), std::invalid_argument);
    EXPECT_THROW(rollOnFingers3d(ball, fingers_, exampleSwing(), task), std::invalid_argument);
  };
  refused([](BallParameters& ball, RollingTask&) { ball.mass = 0; });
  refused([](BallParameters& ball, RollingTask&) { ball.radius = -0.05; });
  refused([](BallParameters& ball, RollingTask&) { ball.friction = -1; });
  refused([](BallParameters& ball, RollingTask&) { ball.friction = NAN; });
  refused([](BallParameters&, RollingTask& task) { task.tolerance = 0; });
  refused([](BallParameters&, RollingTask& task) { task.sample_step = 0; });
  fingers_.half_spacing = 0.061;
  fingers_.finger_radius = 0.01;
  EXPECT_THROW(rollOnFingers(ball_, fingers_, exampleSwing(), task_), std::invalid_argument);
}

// In all directions of a plane, with friction: the planar equations where the motion is planar.
TEST(RollingIn3d, SlidesAndLeavesAsInThePlane) {
  const FingerPair plane = exampleFingers(false);
  for (const double mu : {0.0, 0.2, 0.5, 0.8, 3.0}) {
    BallParameters ball = exampleBall();
    ball.friction = mu;
    const RollingMotion eqs = rollOnFingers(ball, plane, exampleSwing(), {}),
                        newton = rollOnFingers3d(ball, plane, exampleSwing(), {});
    ASSERT_TRUE(eqs.released && newton.released);
    EXPECT_NEAR(eqs.t_slip, newton.t_slip, 1e-7);
    EXPECT_NEAR(eqs.t_release, newton.t_release, 1e-7) << mu;
    EXPECT_LT((eqs.ball.v_WBall - newton.ball.v_WBall).norm(), 1e-5);
    EXPECT_LT((eqs.w_WBall - newton.w_WBall).norm(), 1e-3);
  }
}

TEST(RollingIn3d, RollsSidewaysWhereAPlaneLetsIt) {
  SwingPath path;
  path.push = {-3, 50, 4};  // x', y' and -z'
  BallParameters ball = exampleBall();
  ball.drag_coefficient = 0;
  RollingTask task;
  task.gravity = 0;
  task.t_end = 0.03;
  const RollingSample end = rollOnFingers3d(ball, exampleFingers(false), path, task).samples.back();
  const double part = 5.0 / 7 * 0.03 * 0.03 / 2;
  EXPECT_NEAR(end.p_FBall.x(), 3 * part, 1e-9);
  EXPECT_NEAR(end.p_FBall.z(), -4 * part, 1e-9);
}

// What Eqs. (21) and (22) are as printed.
TEST(PrintedEquations, LeaveOutTheHandsTurningAndMistakeAProductForASquare) {
  BallParameters ball = exampleBall();
  ball.friction = 1e6;
  SwingPath path = exampleSwing();
  path.roll = {4, 0};
  const FingerPair plane = exampleFingers(false);
  RollingTask task;
  task.t_end = 0.04;
  // The groove's equations are those of a plane where the groove is shallow.
  FingerPair shallow = exampleFingers(true);
  shallow.half_spacing = 1e-7;
  const RollingMotion newton = rollOnFingers3d(ball, shallow, path, task);
  const RollingSample s = newton.samples.back();
  const FingerFrameMotion frame = fingerFrameMotion(plane, path(s.t));
  const Eigen::Vector3d &w = frame.w_F, &dw = frame.dw_F;
  const Eigen::Vector3d g = frame.X_WF.linear().transpose() *
                            flightAcceleration(newton.ball.v_WBall, ball.dragPerMetre(), 9.81);
  const double x = s.p_FBall.x(), dx = s.v_FBall.x();
  const double common = frame.a_F.y() - g.y() + 2 * w.z() * dx;
  EXPECT_NEAR(s.force_F.y(), ball.mass * (common + (dw.z() + w.x() * w.y()) * x), 1e-4);
  EXPECT_GT(std::abs(s.force_F.y() - ball.mass * (common + (dw.z() + w.x() * w.x()) * x)), 5e-3);

  const double drive = -frame.a_F.x() + g.x() + (w.y() * w.y() + w.z() * w.z()) * x;
  const double ddx = drive + s.force_F.x() / ball.mass;
  EXPECT_NEAR(ddx, 5.0 / 7 * (drive + 0.4 * ball.radius * dw.z()), 1e-4);
  EXPECT_GT(std::abs(ddx - 5.0 / 7 * drive), 0.02);
}

}  // namespace
}  // namespace fastball::model
