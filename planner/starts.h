#pragma once

#include <cstdint>
#include <vector>

#include "planner/swing_curve.h"

namespace fastball::planner {

/// Where an optimisation begins.
struct Start {
  const char* name;
  SwingVector x;
  int elbow_sign;
};

/// The stored starts for a target at `azimuth` [rad] from the x axis, and `random` more around them, drawn from `seed`.
std::vector<Start> swingStarts(double azimuth, int random, int64_t seed);

}  // namespace fastball::planner
