#pragma once

#include <memory>

#include "planner/atlas_layer_builder.h"
#include "planner/config.h"
#include "planner/swing_task.h"
#include "planner/window_planner.h"

namespace fastball::planner {

/// Throws through a window, from one of windowStarts().
/// @param facing normal of the rings; @param config must outlive the source, here and below.
std::unique_ptr<ThrowSource> windowThrows(const PlannerConfig& config,
                                          const WindowKind& window,
                                          int family,
                                          const Eigen::Vector3d& facing);

/// The kinetic chain's, from one of storedStarts().
/// @param steepness as SwingTask has it.
std::unique_ptr<ThrowSource> swingThrows(const PlannerConfig& config,
                                         Shoulder shoulder,
                                         SwingGoal goal,
                                         int family,
                                         const Eigen::Vector3d& facing,
                                         double steepness);

}  // namespace fastball::planner
