#pragma once

#include <vector>

#include "planner/window_throw.h"

namespace fastball::planner {

/// Where an optimisation of a throw to a target at `azimuth` [rad] from the x axis begins: the stored throws, seen
/// from there, and their mirror images.
/// @param length [s], of the window.
std::vector<WindowThrow> windowStarts(double azimuth, double length);

/// The throw seen in a mirror: left and right exchanged.
WindowThrow mirrored(WindowThrow x);

/// The same throw, turned about the vertical through the shoulder by `angle` [rad].
WindowThrow turned(WindowThrow x, double angle);

}  // namespace fastball::planner
