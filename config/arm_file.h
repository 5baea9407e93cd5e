#pragma once

#include "config/strict_yaml.h"
#include "model/arm_parameters.h"

namespace fastball::config {

/// Inertia given as {xx, yy, zz} or {xx, yy, zz, xy, xz, yz} [kg m^2]: the true tensor,
/// off-diagonals are minus the products.
/// @throw ConfigError unless a rigid body can have it.
Eigen::Matrix3d readInertia(Section& section, const std::string& key);

/// A map with mass [kg], com [m] and inertia.
model::RigidBody readBody(Section section);

/// A profile (config/arm/wam4-*.yaml) with the mechanics file that it names.
model::ArmParameters readArm(Section profile);

}  // namespace fastball::config
