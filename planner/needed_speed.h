#pragma once

#include <optional>

#include "model/target.h"

namespace fastball::planner {

/// The least speed [m/s] with which a ball can leave a point within `reach` [m] of the origin and reach the
/// target's centre, with drag; nothing if no speed up to 100 m/s does.
std::optional<double> neededSpeed(const model::Target& target,
                                  double reach,
                                  double drag_per_metre,
                                  double gravity);

}  // namespace fastball::planner
