#pragma once

#include <string>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "model/trajectory.h"

namespace fastball::launch {

/// A throw as it was planned and as the simulated arm made it.
struct TrackedThrow {
  swing_plan_t plan;
  model::SampledTrajectory planned;
  int64_t start_utime = 0;          ///< [us], of the plan's t = 0
  std::vector<arm_state_t> states;  ///< one a tick, in order
  double time(const arm_state_t& state) const {
    return 1e-6 * static_cast<double>(state.utime - start_utime);
  }
};

/// One throw of the experiment by the strategy "paper", in this process, the controller following
/// the plan by `law`: "gravity_pd", Eq. (26), or "feed_forward", the full inverse dynamics.
/// @throw std::runtime_error if the throw fails.
TrackedThrow trackedThrow(const std::string& config, const std::string& law);

}  // namespace fastball::launch
