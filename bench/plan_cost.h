#pragma once

#include <vector>

#include "planner/swing_task.h"

namespace fastball::bench {

/// What solving a swing costs: the planner's way and the plain one (bench/dense_swing.h).
struct SolveCost {
  int samples = 0;             ///< of swing and follow-through, at which limits are evaluated
  int parameters = 0;          ///< free variables of Eq. (15)
  double planner_seconds = 0;  ///< mean over the starts
  double planner_speed = 0;    ///< [m/s], release speed of the best solution
  double differences_seconds = 0;
  double differences_speed = 0;
  double differences_violation = 0;  ///< of the best solution's limits, looked at everywhere
};

/// The default throw, joint 2 held, from the stored starts: with the planner's usual grid and that many plain samples.
SolveCost costOfDefaultThrow();
/// The same with fewer and more samples.
std::vector<SolveCost> costBySamples();
/// A throw 0.1 m beside a solved one, with some of the parameters fixed to all of them free.
std::vector<SolveCost> costByParameters(planner::Shoulder shoulder);

}  // namespace fastball::bench
