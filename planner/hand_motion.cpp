#include "planner/hand_motion.h"

#include <cmath>

namespace fastball::planner {

ThrowDirection throwDirection(const model::Arm& arm,
                              const model::Hand& hand,
                              const model::ArmMotion& motion) {
  constexpr int kRounds = 50;
  constexpr double kSettled = 1e-13;  // [rad]
  const Eigen::Matrix3d R_WT = arm.X_WT(motion.q).linear();
  // Velocity of the point of T where a hand that is not turned has its ball, and how others move about it.
  const Eigen::Vector3d& p_HBall = hand.parameters().p_HBall;
  const Eigen::Vector3d v_T = R_WT.transpose() * (arm.pointJacobian(motion.q, p_HBall) * motion.qd);
  const Eigen::Vector3d w_T = R_WT.transpose() * (arm.rotationJacobian(motion.q) * motion.qd);
  ThrowDirection direction;
  WristAngles& wrist = direction.wrist;
  // A turn of the wrist by 1 rad moves the ball by 0.15 m, which turns its velocity by some 0.2 rad: this converges.
  for (int i = 0; i < kRounds; ++i) {
    const Eigen::Vector3d p_TBall = hand.X_TH(wrist.roll, wrist.flexion) * p_HBall;
    const Eigen::Vector3d v = v_T + w_T.cross(p_TBall - p_HBall);
    const WristAngles next{std::atan2(-v.x(), v.y()), std::atan2(v.z(), v.head<2>().norm())};
    const double change = std::abs(next.roll - wrist.roll) + std::abs(next.flexion - wrist.flexion);
    wrist = next;
    direction.speed = v.norm();
    if (change < kSettled)
      break;
  }
  direction.y_WH = R_WT * hand.X_TH(wrist.roll, wrist.flexion).linear().col(1);
  return direction;
}

model::HandMotion handMotion(const model::Arm& arm,
                             const model::Hand& hand,
                             const WristAngles& wrist,
                             const model::ArmMotion& motion) {
  const Eigen::Isometry3d X_TH = hand.X_TH(wrist.roll, wrist.flexion);
  const Eigen::Vector3d p_TH = X_TH.translation();
  model::HandMotion result;
  result.X_WH = arm.X_WT(motion.q) * X_TH;
  result.v_WH = arm.pointJacobian(motion.q, p_TH) * motion.qd;
  result.a_WH = arm.pointAcceleration(motion.q, motion.qd, motion.qdd, p_TH);
  // Column i of the rotational Jacobian is joint axis i, which turns with the joints before it.
  const model::Jacobian axes = arm.rotationJacobian(motion.q);
  result.w_WH.setZero();
  result.dw_WH.setZero();
  for (int i = 0; i < model::kArmJoints; ++i) {
    const Eigen::Vector3d axis = axes.col(i);
    result.dw_WH += axis * motion.qdd[i] + result.w_WH.cross(axis) * motion.qd[i];
    result.w_WH += axis * motion.qd[i];
  }
  return result;
}

}  // namespace fastball::planner
