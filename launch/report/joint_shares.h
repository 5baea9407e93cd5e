#pragma once

#include <array>

#include "launch/throw_record.h"
#include "model/arm_parameters.h"

namespace fastball::launch {

/// Of J1..J4 with their signs, and of the differential that drives J2 and J3 the sum of both magnitudes; 1 is the limit.
using JointShares = std::array<double, model::kArmJoints + 1>;

JointShares speedShares(const model::ArmParameters& arm, const arm_state_t& state);
JointShares torqueShares(const model::ArmParameters& arm, const arm_state_t& state);

/// The largest magnitudes of a throw. The differential's is 0 for an arm without one.
struct JointPeaks {
  JointShares speed{}, torque{};
};
JointPeaks peaksOf(const ThrowRecord& record, const model::ArmParameters& arm);

}  // namespace fastball::launch
