#include "model/hand_support.h"

#include <Eigen/LU>

namespace fastball::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Of a body about the origin of its frame, for velocity and angular velocity in the world.
Matrix6 spatialInertia(const RigidBody& body, const Matrix3d& R_WB) {
  const Matrix3d c = crossMatrix(R_WB * body.p_BCom);
  Matrix6 I;
  I << body.mass * Matrix3d::Identity(), -body.mass * c, body.mass * c,
      R_WB * body.I_BCom * R_WB.transpose() - body.mass * c * c;
  return I;
}

}  // namespace

HandSupport handSupport(const Arm& arm,
                        const HandParameters& hand,
                        const Vector4& q,
                        const Eigen::Vector2d& q_wrist,
                        const SupportVector& kp,
                        const SupportVector& kd) {
  const Matrix3d R_WT = arm.X_WT(q).linear();
  const Matrix3d R_WRoll =
      R_WT * Eigen::AngleAxisd(q_wrist[0], Vector3d::UnitZ()).toRotationMatrix();
  const Matrix3d R_WH =
      R_WRoll * Eigen::AngleAxisd(q_wrist[1], Vector3d::UnitX()).toRotationMatrix();
  HandSupport support;
  support.kp = kp;
  support.kd = kd;
  // Both wrist axes go through the origin of H, which is that of T.
  support.J.topLeftCorner<3, kArmJoints>() = arm.pointJacobian(q, Vector3d::Zero());
  support.J.bottomLeftCorner<3, kArmJoints>() = arm.rotationJacobian(q);
  support.J.bottomRightCorner<3, 2>() << R_WRoll.col(2), R_WRoll.col(0);

  const auto of_wrist = support.J.rightCols<2>();
  const Eigen::Matrix<double, 6, 2> momentum = spatialInertia(hand.payload, R_WH) * of_wrist;
  support.M.topLeftCorner<kArmJoints, kArmJoints>() = arm.massMatrix(q);
  support.M.bottomLeftCorner<2, kArmJoints>() =
      momentum.transpose() * support.J.leftCols<kArmJoints>();
  support.M.topRightCorner<kArmJoints, 2>() =
      support.M.bottomLeftCorner<2, kArmJoints>().transpose();
  support.M.bottomRightCorner<2, 2>() =
      of_wrist.transpose() * momentum + hand.wrist_inertia * Eigen::Matrix2d::Identity();
  return support;
}

SupportedHand::SupportedHand(const HandSupport* support) : support_(support) {
  if (support_ != nullptr)
    inverse_ = support_->M.inverse();
}

void SupportedHand::step(const HandWrench& load_H, const Matrix3d& R_WH, double dt) {
  if (support_ == nullptr)
    return;
  Eigen::Matrix<double, 6, 1> load_W;
  load_W << R_WH * load_H.force, R_WH * load_H.moment;
  edd_ = inverse_ * (support_->J.transpose() * load_W - support_->kp.cwiseProduct(e_) -
                     support_->kd.cwiseProduct(ed_));
  ed_ += dt * edd_;
  e_ += dt * ed_;
}

HandMotion SupportedHand::moved(const HandMotion& planned) const {
  if (support_ == nullptr)
    return planned;
  const Eigen::Matrix<double, 6, 1> by = support_->J * e_, rate = support_->J * ed_,
                                    change = support_->J * edd_;
  HandMotion motion = planned;
  const Vector3d turn = by.tail<3>();
  const double angle = turn.norm();
  if (angle > 0) {
    motion.X_WH.linear() =
        Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * planned.X_WH.linear();
  }
  motion.X_WH.translation() += by.head<3>();
  motion.v_WH += rate.head<3>();
  motion.w_WH += rate.tail<3>();
  motion.a_WH += change.head<3>();
  motion.dw_WH += change.tail<3>();
  return motion;
}

}  // namespace fastball::model
