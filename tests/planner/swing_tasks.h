#pragma once

#include <random>

#include "planner/starts.h"
#include "planner/swing_planner.h"
#include "planner/swing_problem.h"
#include "tests/planner/default_throw.h"

namespace fastball::planner {

/// The default throw as an optimisation.
struct DefaultSwing : DefaultThrow {
  model::Arm arm{config.arm, config.hand.payload};
  model::Hand hand{config.hand};

  SwingTask task(Shoulder shoulder = Shoulder::kHeld) const {
    return swingTask(config, arm, hand, experiment.target, shoulder);
  }
};

/// Parameters about the stored starts, the wrist turned and the shoulder moving.
inline std::vector<Start> randomSwings(int count, int64_t seed) {
  std::vector<Start> starts = randomStarts(Shoulder::kFree, 0, count / 2, seed);
  for (const Start& start : randomStarts(Shoulder::kHeld, 0, count / 2, seed))
    starts.push_back(start);
  std::mt19937_64 engine(static_cast<uint64_t>(seed) + 1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (Start& start : starts) {
    start.x[kAlphaGamma] = 0.3 * number(engine);
    start.x[kPhiGamma] = 0.3 * number(engine);
    start.x[kWristRoll] = 3 * number(engine);
    start.x[kWristFlexion] = 0.5 * number(engine);
  }
  return starts;
}

}  // namespace fastball::planner
