#include "sim_bullet/actuators.h"

#include <gtest/gtest.h>

#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using model::HandVector;

constexpr double kStep = 1e-4;
const HandVector kStill = HandVector::Zero();

HandCommand torqueCommand(double tau) {
  HandCommand command;
  command.tau.setConstant(tau);
  return command;
}

TEST(HandServo, TorqueFollowsWithTheDrivesLag) {
  HandServo servo(experiment().hand, {}, kStep);
  const double lag = experiment().hand.actuator_lag;
  for (int k = 1; k <= 100; ++k) {
    const HandVector tau = servo.step(torqueCommand(0.5), kStill, kStill);
    EXPECT_NEAR(tau[model::kDistalA], 0.5 * (1 - std::exp(-k * kStep / lag)), 1e-12);
  }
}

TEST(HandServo, IsAPdWithFeedForward) {
  model::HandParameters hand = experiment().hand;
  hand.actuator_lag = 0;
  HandServo servo(hand, {}, kStep);
  HandCommand command = torqueCommand(0.1);
  command.kp.setConstant(2);
  command.kd.setConstant(0.01);
  command.q.setConstant(0.3);
  command.qd.setConstant(4);
  const HandVector tau = servo.step(command, HandVector::Constant(0.2), HandVector::Constant(1));
  EXPECT_LT((tau - HandVector::Constant(0.1 + 2 * 0.1 + 0.01 * 3)).norm(), 1e-12);
}

TEST(HandServo, TorqueNeverExceedsItsLimit) {
  HandServo servo(experiment().hand, {}, kStep);
  for (int k = 0; k < 300; ++k) {
    const HandVector tau = servo.step(torqueCommand(k % 2 == 0 ? 1e6 : -1e5), kStill, kStill);
    EXPECT_LE(tau.head<2>().cwiseAbs().maxCoeff(), experiment().hand.wrist_torque_max);
    EXPECT_LE(tau.tail<8>().cwiseAbs().maxCoeff(), experiment().hand.finger_torque_max);
  }
}

TEST(HandServo, DrivesNoFingerBeyondItsSpeed) {
  const double speed = experiment().hand.joint_speed_max;
  HandServo servo(experiment().hand, {}, kStep);
  HandVector tau;
  for (int k = 0; k < 100; ++k)
    tau = servo.step(torqueCommand(1), kStill, HandVector::Constant(speed));
  EXPECT_EQ(tau.tail<8>().norm(), 0);
  tau = servo.step(torqueCommand(1), kStill, HandVector::Constant(-2 * speed));  // braking
  EXPECT_GT(tau.tail<8>().minCoeff(), 0.9);
}

TEST(HandServo, CommandsArriveLateAtEachFingerOnly) {
  model::HandParameters hand = experiment().hand;
  hand.actuator_lag = 0;
  const int thumb = 25, finger_b = 7;
  HandServo servo(hand, {0, thumb * kStep, finger_b * kStep}, kStep);
  const auto sent = [](int k) { return 0.01 * std::max(k, 0); };
  for (int k = 0; k < 60; ++k) {
    const HandVector tau = servo.step(torqueCommand(sent(k)), kStill, kStill);
    EXPECT_NEAR(tau[model::kWristRoll], sent(k), 1e-12);
    EXPECT_NEAR(tau[model::kProximalA], sent(k), 1e-12);
    EXPECT_NEAR(tau[model::kProximalThumb], sent(k - thumb), 1e-12);
    EXPECT_NEAR(tau[model::kDistalThumb], sent(k - thumb), 1e-12);
    EXPECT_NEAR(tau[model::kSpreadB], sent(k - finger_b), 1e-12);
    EXPECT_NEAR(tau[model::kDistalB], sent(k - finger_b), 1e-12);
  }
}

TEST(HandServo, ADelayedCommandIsStillServedAtOnce) {
  // The servo sits in the hand: a joint that is pushed away is held without the dead time.
  model::HandParameters hand = experiment().hand;
  hand.actuator_lag = 0;
  HandServo servo(hand, {0.01, 0.01, 0.01}, kStep);
  HandCommand command;
  command.kp.setConstant(2);
  servo.step(command, kStill, kStill);
  EXPECT_NEAR(servo.step(command, HandVector::Constant(0.1), kStill)[model::kProximalThumb], -0.2,
              1e-12);
}

TEST(StopTorque, PushesBackAndNeverHolds) {
  const StopSettings stop{100, 1};
  EXPECT_EQ(stopTorque(stop, -1, 1, 0, 50), 0);
  EXPECT_EQ(stopTorque(stop, -1, 1, 1, 50), 0);
  EXPECT_NEAR(stopTorque(stop, -1, 1, 1.1, 0), -10, 1e-9);
  EXPECT_NEAR(stopTorque(stop, -1, 1, -1.1, 0), 10, 1e-9);
  EXPECT_LT(stopTorque(stop, -1, 1, 1.1, 5), -10);
  EXPECT_EQ(stopTorque(stop, -1, 1, 1.1, -50), 0);
  EXPECT_EQ(stopTorque(stop, -1, 1, -1.1, 50), 0);
}

}  // namespace
}  // namespace fastball::sim_bullet
