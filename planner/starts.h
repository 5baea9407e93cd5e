#pragma once

#include <cstdint>
#include <vector>

#include "planner/swing_curve.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// Where an optimisation begins.
struct Start {
  const char* name;
  SwingVector x;
  int elbow_sign;  ///< +1: J4 > 0, -1: J4 < 0
};

/// The stored starts for a target at `azimuth` [rad] from the x axis.
std::vector<Start> storedStarts(Shoulder shoulder, double azimuth);

/// `count` starts about the stored ones, drawn from `seed`.
std::vector<Start> randomStarts(Shoulder shoulder, double azimuth, int count, int64_t seed);

}  // namespace fastball::planner
