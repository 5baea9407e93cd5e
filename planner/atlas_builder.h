#pragma once

#include <functional>

#include "planner/atlas.h"
#include "planner/config.h"

namespace fastball::planner {

/// How far a build has come: 0 to 1.
using AtlasProgress = std::function<void(double share)>;

/// Plans throws for all targets of the configuration's grid, each from the throw of a neighbour. The result depends on the
/// configuration alone, not on the number of threads.
/// @param threads at least 1: this one and others. @param progress called from this thread.
Atlas buildAtlas(const PlannerConfig& config, int threads, const AtlasProgress& progress = {});

}  // namespace fastball::planner
