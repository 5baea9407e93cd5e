#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "model/arm.h"
#include "model/arm_rotation.h"

namespace fastball::model {

namespace {

/// Speed [rad/s] below which Coulomb friction is smoothed.
constexpr double kCoulombSpeed = 0.01;

/// Ratio of a joint vector to its limits; joints 2 and 3 share two motors through the differential.
double limitRatio(const Vector4& value, const Vector4& limit, bool differential) {
  const Vector4 ratio = value.cwiseAbs().cwiseQuotient(limit);
  return differential ? std::max({ratio[0], ratio[1] + ratio[2], ratio[3]}) : ratio.maxCoeff();
}

}  // namespace

// Recursive Newton-Euler with everything about DH frame i in frame i; gravity is an acceleration of
// the base.
Vector4 Arm::inverseDynamics(const Vector4& q, const Vector4& qd, const Vector4& qdd) const {
  const auto rotation = rotations(q);
  std::array<Eigen::Vector3d, kArmJoints> force;
  std::array<Eigen::Vector3d, kArmJoints> moment;  // about the origin of frame i
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d dw = Eigen::Vector3d::Zero();
  Eigen::Vector3d a(0, 0, parameters_.gravity);
  for (int i = 0; i < kArmJoints; ++i) {
    const Link& link = links_[i];
    const Eigen::Vector3d w_below = rotation[i].up(w);
    dw = rotation[i].up(dw) + link.axis * qdd[i] + w_below.cross(link.axis) * qd[i];
    w = w_below + link.axis * qd[i];
    a = rotation[i].up(a) + dw.cross(link.p) + w.cross(w.cross(link.p));
    force[i] = link.mass * a + dw.cross(link.h) + w.cross(w.cross(link.h));
    moment[i] = link.I * dw + w.cross(link.I * w) + link.h.cross(a);
  }
  Vector4 tau = parameters_.drive_inertia.cwiseProduct(qdd);
  for (int i = kArmJoints - 1; i >= 0; --i) {
    moment[i] += links_[i].p.cross(force[i]);  // about the origin of frame i-1
    tau[i] += links_[i].axis.dot(moment[i]);
    if (i > 0) {
      force[i - 1] += rotation[i].down(force[i]);
      moment[i - 1] += rotation[i].down(moment[i]);
    }
  }
  return tau;
}

Vector4 Arm::gravityTorque(const Vector4& q) const {
  return inverseDynamics(q, Vector4::Zero(), Vector4::Zero());
}

// Composite rigid bodies: `mass`, `h` and `I` are those of links i..4 together.
Matrix4 Arm::massMatrix(const Vector4& q) const {
  const auto rotation = rotations(q);
  Matrix4 M;
  double mass = 0;
  Eigen::Vector3d h = Eigen::Vector3d::Zero();
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  for (int i = kArmJoints - 1; i >= 0; --i) {
    const Link& link = links_[i];
    mass += link.mass;
    h += link.h;
    I += link.I;
    // From the origin of frame i to that of frame i-1: I' = I + 2 (h.p) E - h p' - p h' + m (p.p E
    // - p p').
    const Eigen::Vector3d& p = link.p;
    const Eigen::Matrix3d hp = (h + 0.5 * mass * p) * p.transpose();
    I -= hp + hp.transpose();
    I.diagonal().array() += 2 * h.dot(p) + mass * p.squaredNorm();
    h += mass * p;

    // Force and moment of a unit acceleration of joint i, carried down to the axes below.
    Eigen::Vector3d force = link.axis.cross(h);
    Eigen::Vector3d moment = I * link.axis;
    M(i, i) = link.axis.dot(moment) + parameters_.drive_inertia[i];
    for (int j = i - 1; j >= 0; --j) {
      force = rotation[j + 1].down(force);
      moment = rotation[j + 1].down(moment) + links_[j].p.cross(force);
      M(i, j) = M(j, i) = links_[j].axis.dot(moment);
    }

    const Eigen::Matrix3d R = rotation[i].matrix();
    h = R * h;
    I = R * I * R.transpose();
  }
  return M;
}

Vector4 Arm::forwardDynamics(const Vector4& q, const Vector4& qd, const Vector4& tau) const {
  return massMatrix(q).llt().solve(tau - inverseDynamics(q, qd, Vector4::Zero()));
}

Vector4 Arm::frictionTorque(const Vector4& qd) const {
  Vector4 tau;
  for (int i = 0; i < kArmJoints; ++i) {
    tau[i] = parameters_.viscous_friction[i] * qd[i] +
             parameters_.coulomb_friction[i] * std::tanh(qd[i] / kCoulombSpeed);
  }
  return tau;
}

Vector4 Arm::frictionSlope(const Vector4& qd) const {
  Vector4 slope;
  for (int i = 0; i < kArmJoints; ++i) {
    const double smoothed_sign = std::tanh(qd[i] / kCoulombSpeed);
    slope[i] = parameters_.viscous_friction[i] + parameters_.coulomb_friction[i] / kCoulombSpeed *
                                                     (1 - smoothed_sign * smoothed_sign);
  }
  return slope;
}

double Arm::speedRatio(const Vector4& qd) const {
  return limitRatio(qd, parameters_.qd_max, parameters_.differential);
}

double Arm::torqueRatio(const Vector4& tau) const {
  return limitRatio(tau, parameters_.tau_max, parameters_.differential);
}

Vector4 Arm::clipTorque(const Vector4& tau) const {
  const Vector4& limit = parameters_.tau_max;
  Vector4 clipped = tau.cwiseMax(-limit).cwiseMin(limit);
  if (parameters_.differential) {
    const double ratio = std::abs(tau[1]) / limit[1] + std::abs(tau[2]) / limit[2];
    clipped.segment<2>(1) = tau.segment<2>(1) / std::max(1.0, ratio);
  }
  return clipped;
}

}  // namespace fastball::model
