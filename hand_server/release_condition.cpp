#include "hand_server/release_condition.h"

namespace fastball::hand_server {

Eigen::Vector3d carryingAcceleration(const model::Arm& arm,
                                     const model::ArmMotion& motion,
                                     const Eigen::Isometry3d& X_TH,
                                     const Eigen::Vector3d& p_HBall) {
  const Eigen::Vector3d a_W =
      arm.pointAcceleration(motion.q, motion.qd, motion.qdd, X_TH * p_HBall);
  const Eigen::Vector3d g_W(0, 0, -arm.parameters().gravity);
  return (arm.X_WT(motion.q).linear() * X_TH.linear()).transpose() * (a_W - g_W);
}

double pushingAcceleration(const model::Arm& arm,
                           const model::ArmMotion& motion,
                           const Eigen::Isometry3d& X_TH,
                           const Eigen::Vector3d& p_HBall) {
  return carryingAcceleration(arm, motion, X_TH, p_HBall).y();
}

}  // namespace fastball::hand_server
