#include "model/rigid_body.h"

namespace fastball::model {

namespace {

/// Inertia about a point at `r` from a point mass.
Eigen::Matrix3d pointMassInertia(double mass, const Eigen::Vector3d& r) {
  return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

}  // namespace

RigidBody transformed(const Eigen::Isometry3d& X_AB, const RigidBody& body) {
  const Eigen::Matrix3d R_AB = X_AB.linear();
  return {body.mass, X_AB * body.p_BCom, R_AB * body.I_BCom * R_AB.transpose()};
}

RigidBody combine(const RigidBody& first, const RigidBody& second) {
  const double mass = first.mass + second.mass;
  if (mass == 0) {
    return {0, Eigen::Vector3d::Zero(), first.I_BCom + second.I_BCom};
  }
  const Eigen::Vector3d com = (first.mass * first.p_BCom + second.mass * second.p_BCom) / mass;
  return {mass, com,
          first.I_BCom + pointMassInertia(first.mass, first.p_BCom - com) + second.I_BCom +
              pointMassInertia(second.mass, second.p_BCom - com)};
}

Eigen::Matrix3d inertiaAboutOrigin(const RigidBody& body) {
  return body.I_BCom + pointMassInertia(body.mass, body.p_BCom);
}

RigidBody solidSphere(double mass, double radius, const Eigen::Vector3d& p_BCom) {
  return {mass, p_BCom, 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity()};
}

}  // namespace fastball::model
