#pragma once

#include <optional>
#include <string>

#include "model/arm_parameters.h"
#include "planner/config.h"
#include "planner/plan.h"

namespace fastball::planner {

/// Why no throw can be planned with the configuration: one sentence; or nothing.
std::optional<std::string> configFault(const PlannerConfig& config);

/// Why the request cannot be planned for at all: one sentence; or nothing.
std::optional<std::string> requestFault(const ThrowRequest& request, const PlannerConfig& config);

/// Farthest [m] that the ball centre can be from the shoulder, the arm straight; p_TBall [m], its
/// place in the tool frame.
double armReach(const model::ArmParameters& arm, const Eigen::Vector3d& p_TBall);

}  // namespace fastball::planner
