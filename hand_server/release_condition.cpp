#include "hand_server/release_condition.h"

namespace fastball::hand_server {

double pushingAcceleration(const model::Arm& arm,
                           const model::ArmMotion& motion,
                           const Eigen::Isometry3d& X_TH,
                           const Eigen::Vector3d& p_HBall) {
  const Eigen::Vector3d a_W =
      arm.pointAcceleration(motion.q, motion.qd, motion.qdd, X_TH * p_HBall);
  const Eigen::Vector3d g_W(0, 0, -arm.parameters().gravity);
  const Eigen::Vector3d y_W = (arm.X_WT(motion.q).linear() * X_TH.linear()).col(1);
  return y_W.dot(a_W - g_W);
}

}  // namespace fastball::hand_server
