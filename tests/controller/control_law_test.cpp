// The control law on the model of the arm: how well it follows, and that it is stable at 1 kHz.
#include "controller/control_law.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "tests/controller/closed_loop.h"

namespace fastball::controller {
namespace {

struct TrackingError {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();   ///< [rad], largest magnitudes
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();  ///< [rad/s]
  int clipped = 0;                               ///< ticks
};

TrackingError follow(Law law, const model::SampledTrajectory& trajectory) {
  const ControllerConfig config = loadConfig(kExperimentPath);
  const ControlLaw control(testArm(), config.kp, config.kd);
  SimulatedArm arm{testArm(), trajectory.at(0).q};
  TrackingError error;
  for (int k = 0; k * 1e-3 <= trajectory.duration(); ++k) {
    const model::ArmMotion desired = trajectory.at(k * 1e-3);
    error.q = error.q.cwiseMax((desired.q - arm.q).cwiseAbs());
    error.qd = error.qd.cwiseMax((desired.qd - arm.qd).cwiseAbs());
    const ControlLaw::Torque torque = control.torque(law, desired, arm.q, arm.qd);
    error.clipped += torque.clipped ? 1 : 0;
    arm.tick(torque.tau);
  }
  return error;
}

TEST(ControlLaw, FeedForwardFollowsASwingWithinAMilliradian) {
  const Plan plan = swingPlan();
  ASSERT_FALSE(planFault(testArm(), plan)) << *planFault(testArm(), plan);
  const TrackingError error = follow(Law::kFeedForward, plan.trajectory);
  EXPECT_LT(error.q.maxCoeff(), 1e-3) << error.q.transpose();
  EXPECT_LT(error.qd.maxCoeff(), 0.02) << error.qd.transpose();
  EXPECT_EQ(error.clipped, 0);
}

// Eq. (26) leaves the inertial torque to the error.
TEST(ControlLaw, GravityPdFollowsWithALargerButBoundedError) {
  const Plan plan = swingPlan();
  const double feed_forward = follow(Law::kFeedForward, plan.trajectory).q.maxCoeff();
  const double gravity_pd = follow(Law::kGravityPd, plan.trajectory).q.maxCoeff();
  EXPECT_GT(gravity_pd, 5 * feed_forward);
  EXPECT_LT(gravity_pd, 0.02);
}

TEST(ControlLaw, NothingIsAddedToGravityAtRest) {
  const ControlLaw control(testArm(), Eigen::Vector4d::Constant(100), Eigen::Vector4d::Constant(1));
  const model::ArmMotion rest{kBack};
  const Eigen::Vector4d gravity = testArm().gravityTorque(kBack);
  for (const Law law : {Law::kFeedForward, Law::kGravityPd}) {
    const auto torque = control.torque(law, rest, kBack, Eigen::Vector4d::Zero());
    EXPECT_LT((torque.tau - gravity).norm(), 1e-12);
    EXPECT_FALSE(torque.clipped);
  }
}

TEST(ControlLaw, AnErrorTooLargeForTheDrivesIsClippedAndSaid) {
  const ControlLaw control(testArm(), Eigen::Vector4d::Constant(1e4), Eigen::Vector4d::Zero());
  const auto torque =
      control.torque(Law::kGravityPd, model::ArmMotion{kBack},
                     kBack + Eigen::Vector4d::Constant(0.5), Eigen::Vector4d::Zero());
  EXPECT_TRUE(torque.clipped);
  EXPECT_NEAR(testArm().torqueRatio(torque.tau), 1, 1e-12);
}

/// Largest magnitude of an eigenvalue of the sampled loop: inertia M under PD at 1 kHz, torque held over each tick and
/// applied `delay` (0 or 1) ticks late. Below 1 it is stable.
double spectralRadius(const Eigen::Matrix4d& M, const ControllerConfig& config, int delay) {
  constexpr double kT = 1e-3;
  const Eigen::Matrix4d M_inverse = M.inverse();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(8, 8);
  A.topRightCorner(4, 4) = kT * Eigen::Matrix4d::Identity();
  Eigen::MatrixXd B(8, 4);
  B << 0.5 * kT * kT * M_inverse, kT * M_inverse;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4, 8);
  K.leftCols(4) = config.kp.asDiagonal();
  K.rightCols(4) = config.kd.asDiagonal();
  if (delay == 0) {
    return Eigen::MatrixXd(A - B * K).eigenvalues().cwiseAbs().maxCoeff();
  }
  Eigen::MatrixXd late = Eigen::MatrixXd::Zero(12, 12);
  late.topLeftCorner(8, 8) = A;
  late.topRightCorner(8, 4) = B;
  late.bottomLeftCorner(4, 8) = -K;
  return late.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(ControlLaw, GainsAreStableInEveryPoseEvenWithATickOfDelay) {
  const ControllerConfig config = loadConfig(kExperimentPath);
  const model::Arm arm = testArm();
  const model::ArmParameters& limits = arm.parameters();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector4d q;
    for (int j = 0; j < model::kArmJoints; ++j) {
      q[j] = limits.q_min[j] + share(random) * (limits.q_max[j] - limits.q_min[j]);
    }
    // With the elbow straight the upper arm's twist has least inertia.
    if (i % 10 == 0) {
      q[3] = 0;
    }
    const Eigen::Matrix4d M = arm.massMatrix(q);
    largest = std::max({largest, spectralRadius(M, config, 0), spectralRadius(M, config, 1)});
  }
  // 0.98 a tick: errors die out with a time constant of 50 ms or less.
  EXPECT_LT(largest, 0.98);
}

}  // namespace
}  // namespace fastball::controller
