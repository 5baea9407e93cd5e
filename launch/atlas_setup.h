#pragma once

#include <filesystem>

#include "launch/progress.h"
#include "planner/config.h"

namespace fastball::launch {

/// Sees that there is an atlas of throws for a configuration: makes it, with a progress bar and a
/// thread on each core, if there is none in `folder` or if `rebuild` says so. Says in one line what
/// was done; a folder that cannot be written is said too, and no failure: throws are then planned
/// without an atlas. Nor is a configuration by which nothing can be planned, which the planner will
/// refuse.
/// @return whether there is one now.
bool ensureAtlas(const planner::PlannerConfig& config,
                 const std::filesystem::path& folder,
                 bool rebuild,
                 Progress& progress);

}  // namespace fastball::launch
