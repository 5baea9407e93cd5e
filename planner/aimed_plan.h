#pragma once

#include "planner/planner.h"

namespace fastball::planner {

/// The plan for a set-up with the biases of the request: aimed beside the target by as much as they
/// move the landing, at most by 0.3 m, so that the landing expected is its centre. Where that aim
/// is out of reach, or only within that of a throw of another kind (without a window, or with
/// another velocity), half or a quarter of the way to it, else the target itself; Plan::landing
/// says what is expected. Without biases it is planner.plan().
PlanResult planAimed(const Planner& planner, const ThrowRequest& request);

}  // namespace fastball::planner
