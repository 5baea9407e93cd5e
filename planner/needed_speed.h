#pragma once

#include <optional>

#include "model/target.h"

namespace fastball::planner {

/// About the least speed [m/s] with which a ball can leave the sphere of radius `reach` [m] about
/// the shoulder and reach the target's centre, with drag [1/m] and gravity [m/s^2]: of places 20
/// and directions 5 degrees apart in the vertical plane through shoulder and target. Nothing if no
/// speed up to 100 m/s does.
std::optional<double> neededSpeed(const model::Target& target,
                                  double reach,
                                  double drag_per_metre,
                                  double gravity);

}  // namespace fastball::planner
