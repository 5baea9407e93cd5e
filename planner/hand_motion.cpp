#include "planner/hand_motion.h"

#include <cmath>

namespace fastball::planner {

ThrowDirection throwDirection(const model::Arm& arm,
                              const model::ArmMotion& motion,
                              const Eigen::Vector3d& p_TBall) {
  const Eigen::Matrix3d R_WT = arm.X_WT(motion.q).linear();
  const Eigen::Vector3d v_W = arm.pointJacobian(motion.q, p_TBall) * motion.qd;
  const Eigen::Vector3d v_T = R_WT.transpose() * v_W;
  ThrowDirection direction;
  direction.wrist_roll = std::atan2(-v_T.x(), v_T.y());
  direction.y_WH =
      R_WT * Eigen::Vector3d(-std::sin(direction.wrist_roll), std::cos(direction.wrist_roll), 0);
  return direction;
}

model::HandMotion handMotion(const model::Arm& arm,
                             const model::Hand& hand,
                             double roll,
                             const model::ArmMotion& motion) {
  const Eigen::Isometry3d X_TH = hand.X_TH(roll, 0);
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
