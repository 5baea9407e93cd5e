#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::controller {

/// A motion to follow, and when its parts begin [s from its start].
struct Plan {
  int64_t id = 0;
  double t_ready = 0;      ///< approach ends
  double t_swing = 0;      ///< swing begins
  double t_swing_end = 0;  ///< follow-through begins
  model::SampledTrajectory trajectory;
  double t_release = 0;                               ///< the ball leaves the hand
  double flight_time = 0;                             ///< [s], until it is at the target
  Eigen::Vector2d q_wrist = Eigen::Vector2d::Zero();  ///< [rad], roll and flexion in the swing
};

/// The same to the last digit.
bool operator==(const Plan& a, const Plan& b);

/// Why the plan must not be followed, wherever the arm is: times out of order, not finite, not at rest at both ends, or
/// beyond a position limit (the stops less the arm's margin), a speed or a torque limit (drive
/// inertia and friction included) on a 1 ms grid. One sentence, or nothing.
std::optional<std::string> planFault(const model::Arm& arm, const Plan& plan);

/// Why the plan must not be followed from an arm at q [rad], or nothing.
/// @param tolerance [rad], of each joint.
std::optional<std::string> startFault(const Plan& plan, const Eigen::Vector4d& q, double tolerance);

}  // namespace fastball::controller
