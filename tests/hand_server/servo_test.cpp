// The gains on a finger and a wrist as the hand's servo drives them: ten steps a tick, behind the lag of the drives.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

constexpr double kStep = 1e-4;

/// Two phalanges that move in their plane near the grasp posture, with a ball of stiffness `contact` [N/m] against the middle
/// of the distal one.
class PlanarFinger {
 public:
  PlanarFinger(const model::HandParameters& hand, double contact) : lag_(hand.actuator_lag) {
    const double m = hand.finger_mass / 2, l1 = hand.proximal_length, l2 = hand.distal_length;
    const double c = std::cos(testHand().parallelFinger(0.06)[2]);
    const double i1 = m * l1 * l1 / 3, i2 = m * l2 * l2 / 3, cross = m * l1 * l2 / 2 * c;
    M_ << i1 + i2 + m * l1 * l1 + 2 * cross, i2 + cross, i2 + cross, i2;
    M_.diagonal().array() += hand.joint_inertia;
    lever_ << l1 * c + l2 / 2, l2 / 2;
    contact_ = contact * lever_ * lever_.transpose();
  }
  void step(const Eigen::Vector2d& kp, const Eigen::Vector2d& kd) {
    const Eigen::Vector2d command = -kp.cwiseProduct(q) - kd.cwiseProduct(qd);
    tau_ += (1 - std::exp(-kStep / lag_)) * (command - tau_);
    qd += kStep * M_.inverse() * (tau_ - contact_ * q);
    q += kStep * qd;
  }
  Eigen::Vector2d q{0.1, -0.1}, qd{0, 0};

 private:
  double lag_;
  Eigen::Matrix2d M_, contact_;
  Eigen::Vector2d lever_, tau_{0, 0};
};

TEST(Servo, AFingerComesToRestFreeAndAgainstTheBall) {
  const HandServerConfig config = loadConfig(kExperimentPath);
  for (const double contact :
       {0.0, 3e3, 6e3, 1.2e4}) {  // [N/m], of the ball from a light grip to a hard one
    PlanarFinger finger(experiment().hand, contact);
    for (int i = 0; i < 400; ++i)
      finger.step(config.release.kp.segment<2>(model::kProximalThumb),
                  config.release.kd.segment<2>(model::kProximalThumb));
    EXPECT_LT(finger.q.norm(), 1e-3 * 0.14) << contact << " N/m, after 40 ms";
  }
}

/// Largest angle [rad] of one joint 40 ms after it stood 0.1 rad off.
double remains(double inertia, double kp, double kd, double lag) {
  double q = 0.1, qd = 0, tau = 0, largest = 0;
  for (int i = 0; i < 600; ++i) {
    tau += (1 - std::exp(-kStep / lag)) * (-kp * q - kd * qd - tau);
    qd += kStep * tau / inertia;
    q += kStep * qd;
    if (i >= 400)
      largest = std::max(largest, std::abs(q));
  }
  return largest;
}

TEST(Servo, WristAndSpreadComeToRest) {
  const HandServerConfig config = loadConfig(kExperimentPath);
  const model::HandParameters& hand = experiment().hand;
  const model::RigidBody& whole = hand.payload;
  const double roll = hand.wrist_inertia + whole.I_BCom(2, 2);
  const double flexion =
      hand.wrist_inertia + whole.I_BCom(0, 0) + whole.mass * whole.p_BCom.z() * whole.p_BCom.z();
  EXPECT_LT(remains(roll, config.release.kp[0], config.release.kd[0], hand.actuator_lag), 1e-3);
  EXPECT_LT(remains(flexion, config.release.kp[1], config.release.kd[1], hand.actuator_lag), 1e-3);
  // A finger parallel to the axis of its spread has hardly more than the inertia of the drive.
  EXPECT_LT(remains(1.1 * hand.joint_inertia, config.release.kp[2], config.release.kd[2],
                    hand.actuator_lag),
            1e-3);
}

}  // namespace
}  // namespace fastball::hand_server
