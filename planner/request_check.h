#pragma once

#include <optional>
#include <string>

#include "model/arm_parameters.h"
#include "planner/plan.h"

namespace fastball::planner {

/// Why the request cannot be planned for at all: one sentence; or nothing.
std::optional<std::string> requestFault(const ThrowRequest& request,
                                        const model::ArmParameters& arm,
                                        const Eigen::Vector3d& p_TBall);

/// Farthest [m] that the ball centre can be from the shoulder, the arm straight.
double armReach(const model::ArmParameters& arm, const Eigen::Vector3d& p_TBall);

}  // namespace fastball::planner
