#include <cmath>

#include "model/arm.h"
#include "model/arm_derivatives.h"
#include "model/arm_rotation.h"
#include "model/rigid_body.h"

namespace fastball::model {

/// Orientations and origins of DH frames 0..4 in the world. Frame i-1's z axis is the axis of joint
/// i.
struct Arm::Frames {
  std::array<Eigen::Matrix3d, kArmJoints + 1> R_W;
  std::array<Eigen::Vector3d, kArmJoints + 1> p_W;

  auto axis(int joint) const { return R_W[joint].col(2); }
};

Arm::Arm(const ArmParameters& parameters, const RigidBody& payload) : parameters_(parameters) {
  const Eigen::Isometry3d X_4T(Eigen::Translation3d(0, 0, parameters.tool_plate_distance));
  for (int i = 0; i < kArmJoints; ++i) {
    const DhRow& row = parameters.dh[i];
    RigidBody body = parameters.links[i];
    if (i == kArmJoints - 1) {
      body = combine(body, transformed(X_4T, payload));
    }
    Link& link = links_[i];
    link.cos_alpha = std::cos(row.alpha);
    link.sin_alpha = std::sin(row.alpha);
    link.axis = {0, link.sin_alpha, link.cos_alpha};
    link.p = {row.a, row.d * link.sin_alpha, row.d * link.cos_alpha};
    link.mass = body.mass;
    link.h = body.mass * body.p_BCom;
    link.I = inertiaAboutOrigin(body);
  }
}

std::array<Arm::Rotation, kArmJoints> Arm::rotations(const Vector4& q) const {
  std::array<Rotation, kArmJoints> result;
  for (int i = 0; i < kArmJoints; ++i) {
    result[i] = {std::cos(q[i]), std::sin(q[i]), links_[i].cos_alpha, links_[i].sin_alpha};
  }
  return result;
}

Arm::Frames Arm::frames(const Vector4& q) const {
  const auto rotation = rotations(q);
  Frames result;
  result.R_W[0].setIdentity();
  result.p_W[0].setZero();
  for (int i = 0; i < kArmJoints; ++i) {
    result.R_W[i + 1] = result.R_W[i] * rotation[i].matrix();
    result.p_W[i + 1] = result.p_W[i] + result.R_W[i + 1] * links_[i].p;
  }
  return result;
}

Eigen::Isometry3d Arm::X_WLink(const Vector4& q, int i) const {
  const Frames at = frames(q);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = at.R_W[i];
  X.translation() = at.p_W[i];
  return X;
}

Eigen::Isometry3d Arm::X_WT(const Vector4& q) const {
  return X_WLink(q, kArmJoints) * Eigen::Translation3d(0, 0, parameters_.tool_plate_distance);
}

Eigen::Vector3d Arm::p_WPoint(const Vector4& q, const Eigen::Vector3d& p_TP) const {
  return X_WT(q) * p_TP;
}

Jacobian Arm::pointJacobian(const Vector4& q, const Eigen::Vector3d& p_TP) const {
  const Frames at = frames(q);
  const Eigen::Vector3d p_4P = p_TP + Eigen::Vector3d(0, 0, parameters_.tool_plate_distance);
  const Eigen::Vector3d p_WP = at.p_W[kArmJoints] + at.R_W[kArmJoints] * p_4P;
  Jacobian J;
  for (int i = 0; i < kArmJoints; ++i) {
    J.col(i) = at.axis(i).cross(p_WP - at.p_W[i]);
  }
  return J;
}

Jacobian Arm::rotationJacobian(const Vector4& q) const {
  const Frames at = frames(q);
  Jacobian J;
  for (int i = 0; i < kArmJoints; ++i) {
    J.col(i) = at.axis(i);
  }
  return J;
}

Eigen::Vector3d Arm::pointAcceleration(const Vector4& q,
                                       const Vector4& qd,
                                       const Vector4& qdd,
                                       const Eigen::Vector3d& p_TP) const {
  const Frames at = frames(q);
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d dw = Eigen::Vector3d::Zero();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  for (int i = 0; i < kArmJoints; ++i) {
    dw += at.axis(i) * qdd[i] + w.cross(at.axis(i)) * qd[i];
    w += at.axis(i) * qd[i];
    const Eigen::Vector3d r = at.p_W[i + 1] - at.p_W[i];
    a += dw.cross(r) + w.cross(w.cross(r));
  }
  const Eigen::Vector3d r =
      at.R_W[kArmJoints] * (p_TP + Eigen::Vector3d(0, 0, parameters_.tool_plate_distance));
  return a + dw.cross(r) + w.cross(w.cross(r));
}

// The angle of joint j turns P about the joint's axis, and with it P's motion relative to the link
// below; what that link itself contributes changes only because P is elsewhere.
PointMotion Arm::pointMotion(const Vector4& q,
                             const Vector4& qd,
                             const Vector4& qdd,
                             const Eigen::Vector3d& p_TP) const {
  struct Below {  // the link below joint j, and P if it were fixed in it
    Eigen::Vector3d w, dw, v, a;
  };
  const Frames at = frames(q);
  const Eigen::Vector3d p_4P = p_TP + Eigen::Vector3d(0, 0, parameters_.tool_plate_distance);
  PointMotion point;
  point.p = at.p_W[kArmJoints] + at.R_W[kArmJoints] * p_4P;
  std::array<Below, kArmJoints + 1> below;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  below[0] = {zero, zero, zero, zero};
  for (int j = 0; j < kArmJoints; ++j) {
    const Eigen::Vector3d axis = at.axis(j);
    const Eigen::Vector3d arc = axis.cross(point.p - at.p_W[j]);
    const auto& [w, dw, v, a] = below[j];
    below[j + 1] = {w + axis * qd[j], dw + axis * qdd[j] + w.cross(axis) * qd[j], v + arc * qd[j],
                    a + arc * qdd[j] + (2 * w + axis * qd[j]).cross(arc) * qd[j]};
    point.J.col(j) = arc;
  }
  point.v = below[kArmJoints].v;
  point.a = below[kArmJoints].a;
  for (int j = 0; j < kArmJoints; ++j) {
    const Eigen::Vector3d axis = at.axis(j);
    const Eigen::Vector3d arc = point.J.col(j);
    const auto& [w, dw, v, a] = below[j];
    const Eigen::Vector3d v_turn = axis.cross(point.v - v);
    const Eigen::Vector3d a_relative = point.a - a - 2 * w.cross(point.v - v);
    point.dv_dq.col(j) = w.cross(arc) + v_turn;
    point.da_dq.col(j) =
        dw.cross(arc) + w.cross(w.cross(arc) + 2 * v_turn) + axis.cross(a_relative);
  }
  point.da_dqd = 2 * point.dv_dq;
  return point;
}

DirectionMotion Arm::toolAxis(const Vector4& q) const {
  const Frames at = frames(q);
  DirectionMotion direction;
  direction.e = at.R_W[kArmJoints].col(2);
  for (int j = 0; j < kArmJoints; ++j) {
    direction.de_dq.col(j) = at.axis(j).cross(direction.e);
  }
  return direction;
}

}  // namespace fastball::model
