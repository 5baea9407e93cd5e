#include "model/finger_body.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fastball::model {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A drive's torque fades to nothing over this share of its greatest speed.
constexpr double kFadeShare = 0.05;

double slenderInertia(double mass, double length, double radius) {
  return mass * (3 * radius * radius + length * length) / 12;
}

}  // namespace

FingerBody::FingerBody(const Hand& hand, Finger finger, const HandVector& q, const HandVector& tau)
    : hand_(hand.parameters()), proximal_(Hand::proximalJoint(finger)) {
  phalanx_mass_ = hand_.finger_mass / 2;
  inertia_ << slenderInertia(phalanx_mass_, hand_.proximal_length, hand_.finger_radius),
      slenderInertia(phalanx_mass_, hand_.distal_length, hand_.finger_radius);
  inertia_.array() += hand_.joint_inertia;
  const double azimuth = hand_.azimuth[finger];
  const double turned = azimuth + (finger == kThumb ? 0 : q[proximal_ - 1]);
  u_ = {std::cos(turned), std::sin(turned), 0};
  axis_ = u_.cross(Vector3d::UnitZ());
  p_base_ = {hand_.base_radius * std::cos(azimuth), hand_.base_radius * std::sin(azimuth),
             hand_.base_distance};
  q_ = q.segment<2>(proximal_);
  qd_.setZero();
  tau_ = tau.segment<2>(proximal_);
  placePhalanges();
}

void FingerBody::placePhalanges() {
  const double a = q_[0], b = q_[0] + q_[1];
  const Vector3d p_elbow =
      p_base_ +
      hand_.proximal_length * Vector3d(std::cos(a) * Vector3d::UnitZ() - std::sin(a) * u_);
  const Vector3d p_tip =
      p_elbow + hand_.distal_length * Vector3d(std::cos(b) * Vector3d::UnitZ() - std::sin(b) * u_);
  phalanges_ = {Segment{p_base_, p_elbow}, Segment{p_elbow, p_tip}};
}

Vector3d FingerBody::velocityAt(int phalanx, const Vector3d& p_H) const {
  Vector3d v = qd_[0] * axis_.cross(p_H - p_base_);
  if (phalanx == 1)
    v += qd_[1] * axis_.cross(p_H - phalanges_[1].p_start);
  return v;
}

void FingerBody::push(int phalanx, const Vector3d& p_H, const Vector3d& force_H) {
  pushed_[0] += axis_.dot((p_H - p_base_).cross(force_H));
  if (phalanx == 1)
    pushed_[1] += axis_.dot((p_H - phalanges_[1].p_start).cross(force_H));
}

Vector2d FingerBody::driveTorque(const JointTargets& targets, double dt) {
  const auto of = [this](const HandVector& all) { return all.segment<2>(proximal_); };
  Vector2d wanted = of(targets.tau) + of(targets.kp).cwiseProduct(of(targets.q) - q_) +
                    of(targets.kd).cwiseProduct(of(targets.qd) - qd_);
  wanted = wanted.cwiseMax(-hand_.finger_torque_max).cwiseMin(hand_.finger_torque_max);
  const double lag = hand_.actuator_lag;
  tau_ += (lag > 0 ? 1 - std::exp(-dt / lag) : 1) * (wanted - tau_);
  Vector2d applied = tau_;
  for (int i = 0; i < 2; ++i) {
    if (applied[i] * qd_[i] > 0)
      applied[i] *=
          std::clamp((1 - std::abs(qd_[i]) / hand_.joint_speed_max) / kFadeShare, 0.0, 1.0);
  }
  return applied;
}

/// Joint torques [N m] of weight and inertia of the phalanges as the hand carries them along.
Vector2d FingerBody::inertialLoad(const HandMotion& hand, double gravity) const {
  const Eigen::Matrix3d R_HW = hand.X_WH.linear().transpose();
  const Vector3d w = R_HW * hand.w_WH, dw = R_HW * hand.dw_WH;
  const Vector3d a_origin = R_HW * (hand.a_WH + gravity * Vector3d::UnitZ());
  Vector2d load;
  load.setZero();
  for (int i = 0; i < 2; ++i) {
    const Vector3d p = (phalanges_[i].p_start + phalanges_[i].p_end) / 2;
    const Vector3d force = -phalanx_mass_ * (a_origin + dw.cross(p) + w.cross(w.cross(p)));
    load[0] += axis_.dot((p - p_base_).cross(force));
    if (i == 1)
      load[1] = axis_.dot((p - phalanges_[1].p_start).cross(force));
  }
  return load;
}

void FingerBody::step(const JointTargets& targets,
                      const HandMotion& hand,
                      double gravity,
                      double dt) {
  const double m = phalanx_mass_, l1 = hand_.proximal_length, l2 = hand_.distal_length;
  const double cross = m * l1 * l2 / 2;
  // With the phalanges' absolute angles a = q1, b = q1 + q2.
  const double aa = inertia_[0] + m * l1 * l1 / 4 + m * l1 * l1;
  const double bb = inertia_[1] + m * l2 * l2 / 4;
  const double ab = cross * std::cos(q_[1]), turn = cross * std::sin(q_[1]);
  const double da = qd_[0], db = qd_[0] + qd_[1];
  const Vector2d torque = driveTorque(targets, dt) + pushed_ + inertialLoad(hand, gravity);
  // Force on a is the first joint's torque less the second's, force on b the second's.
  const double on_a = torque[0] - torque[1] + turn * db * db;
  const double on_b = torque[1] - turn * da * da;
  const double determinant = aa * bb - ab * ab;
  const double dda = (bb * on_a - ab * on_b) / determinant;
  const double ddb = (aa * on_b - ab * on_a) / determinant;

  // Accelerations of the phalanges' middles relative to the hand.
  const Vector3d r1 = phalanges_[0].p_end - p_base_;
  const Vector3d r2 = phalanges_[1].p_end - phalanges_[1].p_start;
  const Vector3d a_elbow = dda * axis_.cross(r1) - da * da * r1;
  const Vector3d a_1 = a_elbow / 2;
  const Vector3d a_2 = a_elbow + (ddb * axis_.cross(r2) - db * db * r2) / 2;
  reaction_.force = -m * (a_1 + a_2);
  reaction_.moment =
      -m * ((p_base_ + r1 / 2).cross(a_1) + (phalanges_[1].p_start + r2 / 2).cross(a_2)) -
      (inertia_[0] * dda + inertia_[1] * ddb) * axis_;

  qd_ += dt * Vector2d(dda, ddb - dda);
  q_ += dt * qd_;
  pushed_.setZero();
  placePhalanges();
}

void FingerBody::follow(const JointTargets& targets) {
  q_ = targets.q.segment<2>(proximal_);
  qd_ = targets.qd.segment<2>(proximal_);
  pushed_.setZero();
  placePhalanges();
}

}  // namespace fastball::model
