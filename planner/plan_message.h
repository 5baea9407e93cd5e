#pragma once

#include "lcmtypes/fastball_types.h"
#include "planner/plan.h"

namespace fastball::planner {

ThrowRequest fromMessage(const plan_request_t& message);

/// SWING_PLAN that answers `request`; plan_ms is left at 0.
swing_plan_t toMessage(const PlanResult& result, const plan_request_t& request);

}  // namespace fastball::planner
