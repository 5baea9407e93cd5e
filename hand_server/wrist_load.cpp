#include "hand_server/wrist_load.h"

#include <Eigen/Geometry>

namespace fastball::hand_server {
namespace {

/// Acceleration of the tool frame: of its origin [m/s^2] and angular [rad/s^2], in the world.
struct ToolMotion {
  Eigen::Vector3d w_WT, a_WT, dw_WT;
};

ToolMotion toolMotion(const model::Arm& arm,
                      const model::ArmMotion& motion,
                      const Eigen::Matrix3d& R_WT) {
  const auto at = [&](const Eigen::Vector3d& p_TP) {
    return arm.pointAcceleration(motion.q, motion.qd, motion.qdd, p_TP);
  };
  ToolMotion tool;
  tool.w_WT = arm.rotationJacobian(motion.q) * motion.qd;
  tool.a_WT = at(Eigen::Vector3d::Zero());
  // A point P has a_P = a_T + dw x r + w x (w x r), and sum over three unit axes e of e x (dw x e) is 2 dw.
  tool.dw_WT.setZero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d r = R_WT.col(i);
    const Eigen::Vector3d turning =
        at(Eigen::Vector3d::Unit(i)) - tool.a_WT - tool.w_WT.cross(tool.w_WT.cross(r));
    tool.dw_WT += 0.5 * r.cross(turning);
  }
  return tool;
}

}  // namespace

Eigen::Vector2d wristLoad(const model::Arm& arm,
                          const model::HandParameters& hand,
                          const model::ArmMotion& motion,
                          const Eigen::Vector2d& q_wrist) {
  const Eigen::Matrix3d R_WT = arm.X_WT(motion.q).linear();
  const Eigen::Matrix3d R_WRoll =
      R_WT * Eigen::AngleAxisd(q_wrist[0], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d R_WH =
      R_WRoll * Eigen::AngleAxisd(q_wrist[1], Eigen::Vector3d::UnitX()).toRotationMatrix();
  const ToolMotion tool = toolMotion(arm, motion, R_WT);
  const Eigen::Vector3d& w = tool.w_WT;
  const model::RigidBody& body = hand.payload;
  const Eigen::Vector3d r = R_WH * body.p_BCom;
  const Eigen::Matrix3d I = R_WH * body.I_BCom * R_WH.transpose();
  const Eigen::Vector3d g_W(0, 0, -arm.parameters().gravity);
  const Eigen::Vector3d a_com = tool.a_WT + tool.dw_WT.cross(r) + w.cross(w.cross(r));
  const Eigen::Vector3d moment = body.mass * r.cross(a_com - g_W) + I * tool.dw_WT + w.cross(I * w);
  return {R_WT.col(2).dot(moment), R_WRoll.col(0).dot(moment)};
}

}  // namespace fastball::hand_server
