// Braking: from full speed to rest, inside the torque limits, and followed by the arm.
#include "controller/stop_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/controller/closed_loop.h"

namespace fastball::controller {
namespace {

constexpr double kShare = 0.8;

struct Stop {
  double time = 0;                                     ///< [s] until rest
  Eigen::Vector4d distance = Eigen::Vector4d::Zero();  ///< [rad]
  double torque_ratio = 0;                             ///< largest share of the torque limits
  bool turned_back = false;
};

Stop brake(const Eigen::Vector4d& q, const Eigen::Vector4d& qd) {
  const model::Arm arm = testArm();
  StopMotion stop(arm, kShare);
  stop.begin(q, qd);
  Stop result;
  for (; !stop.atRest() && result.time < 2; result.time += 1e-3) {
    const model::ArmMotion& m = stop.motion();
    const Eigen::Vector4d tau = arm.inverseDynamics(m.q, m.qd, m.qdd) + arm.frictionTorque(m.qd);
    result.torque_ratio = std::max(result.torque_ratio, arm.torqueRatio(tau));
    result.turned_back = result.turned_back || m.qd.cwiseProduct(qd).minCoeff() < 0;
    stop.advance(1);
  }
  result.distance = stop.motion().q - q;
  return result;
}

TEST(StopMotion, AtRestItHolds) {
  StopMotion stop(testArm(), kShare);
  stop.begin(kBack, Eigen::Vector4d::Zero());
  stop.advance(1000);
  EXPECT_TRUE(stop.atRest());
  EXPECT_EQ(stop.motion().q, kBack);
  EXPECT_TRUE(stop.motion().qdd.isZero(0));
}

TEST(StopMotion, FullSpeedOfEachJointEndsInsideTheTorqueLimits) {
  const model::ArmParameters& limits = experiment().arm;
  for (int joint = 0; joint < model::kArmJoints; ++joint) {
    const Eigen::Vector4d qd = limits.qd_max[joint] * Eigen::Vector4d::Unit(joint);
    const Stop stop = brake({0, 1.2, 0, 1.0}, qd);
    EXPECT_LT(stop.time, 0.3) << "joint " << joint + 1;
    EXPECT_LE(stop.torque_ratio, kShare) << "joint " << joint + 1;
    EXPECT_FALSE(stop.turned_back);
    RecordProperty("joint_" + std::to_string(joint + 1) + "_mrad",
                   static_cast<int>(stop.distance[joint] * 1000));
  }
}

TEST(StopMotion, RandomSpeedsEndAlongTheirOwnDirection) {
  const model::ArmParameters& limits = experiment().arm;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector4d q, qd;
    for (int j = 0; j < model::kArmJoints; ++j) {
      q[j] = 0.5 * (limits.q_min[j] + limits.q_max[j]) + unit(random) * 0.8;
      qd[j] = unit(random) * limits.qd_max[j];
    }
    qd /= std::max(1.0, testArm().speedRatio(qd));
    const Stop stop = brake(q, qd);
    EXPECT_LT(stop.time, 0.5);
    EXPECT_LE(stop.torque_ratio, 1.0);
    EXPECT_FALSE(stop.turned_back);
  }
}

TEST(StopMotion, AJointNearItsStopBrakesHarderThanTheOthers) {
  const model::ArmParameters& limits = experiment().arm;
  Eigen::Vector4d q{0, 1.2, 0, 1.0};
  q[0] = limits.q_max[0] - limits.position_margin - 0.008;
  const Eigen::Vector4d qd{0.5, 0, 0, 5.0};
  const Stop free = brake({0, 1.2, 0, 1.0}, qd);
  const Stop near = brake(q, qd);
  EXPECT_GT(free.distance[0], 0.012) << "this test needs a stop that is nearer";
  EXPECT_LT(near.distance[0], 0.008 + 1e-3);
  EXPECT_LE(near.torque_ratio, 1.0);
}

}  // namespace
}  // namespace fastball::controller
