#pragma once

#include <optional>
#include <string>

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::planner {

/// How much of the arm's speed and torque limits a trajectory uses where it was looked at: every
/// 20 ms or so, and in ever shorter steps, down to 0.1 ms, wherever a limit (of the joints' ranges
/// too) might be exceeded in between.
struct LimitUse {
  double speed_ratio = 0;   ///< 1: at the limit; joints and differential
  double torque_ratio = 0;  ///< the same, inverse dynamics with payload and friction
  /// The worst violation as a sentence (joint, value, limit, time), or nothing.
  std::optional<std::string> violation;
};

/// Looks at the trajectory as its receivers see it: samples joined by quintics.
LimitUse checkLimits(const model::Arm& arm, const model::SampledTrajectory& trajectory);

/// The speed or torque limit of which the trajectory uses the greatest share, as a part of a
/// sentence: "joint 1 turns at 99.8 % of its 2.386 rad/s".
std::string tightestLimit(const model::Arm& arm, const model::SampledTrajectory& trajectory);

}  // namespace fastball::planner
