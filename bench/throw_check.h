#pragma once

#include <string>
#include <vector>

#include "bench/throw_limits.h"
#include "model/trajectory.h"

namespace fastball::bench {

/// How a throw uses one limit.
struct LimitUsed {
  std::string name;        ///< "speed of joint 1"
  double at_release = 0;   ///< share of the limit then; of ranges and clearances: 1 on it, else 0
  double time_active = 0;  ///< share of the time up to the release within 1 % of the limit
};

/// What a trajectory is, looked at every 0.1 ms and with its ball flown by model::land.
struct ThrowCheck {
  /// The largest of ranges [rad], shares of speed and torque limits, clearances [m], and the landing
  /// off the target's centre [m]; infinite if the ball does not come through the target's plane.
  double violation = 0;
  model::BallState release;
  double flight_time = 0;  ///< [s], 0 without a target
  /// Those active at the release or for 5 % of the time before it, as the arm's data sheet has them.
  std::vector<LimitUsed> limits;
};
ThrowCheck checkThrow(const FreeThrow& task,
                      const model::SampledTrajectory& trajectory,
                      double t_release);

}  // namespace fastball::bench
