#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "model/arm_parameters.h"

namespace fastball::model {

/// The same body in another frame: `body` is given in B, the result in A; X_AB is the pose of B in
/// A.
RigidBody transformed(const Eigen::Isometry3d& X_AB, const RigidBody& body);

/// Two bodies of one frame, fixed to each other, as one. Bodies without mass are allowed.
RigidBody combine(const RigidBody& first, const RigidBody& second);

/// Inertia tensor [kg m^2] about the origin of the body's frame (parallel-axis theorem).
Eigen::Matrix3d inertiaAboutOrigin(const RigidBody& body);

/// A solid sphere with its centre at p_BCom [m].
RigidBody solidSphere(double mass, double radius, const Eigen::Vector3d& p_BCom);

}  // namespace fastball::model
