#pragma once

#include "config/strict_yaml.h"
#include "model/arm_parameters.h"

namespace fastball::config {

/// A map with mass [kg], com [m] and inertia about it [kg m^2]: {xx, yy, zz} or {xx, yy, zz, xy,
/// xz, yz}, the true tensor, whose off-diagonals are minus the products.
/// @throw ConfigError also for an inertia that no rigid body has.
model::RigidBody readBody(Section section);

/// A profile (config/arm/wam4-*.yaml) with the mechanics file that it names.
/// @throw ConfigError
model::ArmParameters readArm(Section profile);

}  // namespace fastball::config
