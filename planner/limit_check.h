#pragma once

#include <optional>
#include <string>

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::planner {

/// How much of the arm's limits a trajectory uses, on a grid of 1 ms, and of 0.1 ms wherever a limit is near.
struct LimitUse {
  double position_room =
      0;  ///< [rad], smallest distance from a stop less the arm's margin; negative: violated
  double speed_ratio = 0;   ///< 1: at the limit; joints and differential
  double torque_ratio = 0;  ///< the same, inverse dynamics with payload and friction
  /// The worst violation as a sentence (joint, value, limit, time), or nothing.
  std::optional<std::string> violation;
};

/// Looks at the trajectory as its receivers see it: samples joined by quintics.
LimitUse checkLimits(const model::Arm& arm, const model::SampledTrajectory& trajectory);

/// The limit of which the trajectory uses the greatest share, as a part of a sentence: "joint 1 turns at 99.8 % of its 2.386 rad/s".
std::string tightestLimit(const model::Arm& arm, const model::SampledTrajectory& trajectory);

}  // namespace fastball::planner
