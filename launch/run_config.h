#pragma once

#include <string>
#include <vector>

#include "launch/aim_filter.h"

namespace fastball::launch {

/// Strategies that a throw can be planned by.
inline const std::vector<std::string> kStrategies = {"paper", "robust", "tactile", "adaptive"};

/// Section `run` of the experiment file: how the experiment is conducted.
struct RunConfig {
  std::string strategy;     ///< strategy of the planner when none is named
  double settle = 0;        ///< [s] simulated, from the start of a scene to the start of the plan
  double scene_period = 0;  ///< [s] simulated, between the starts of two scenes
  double camera_lead = 0;   ///< [s] simulated, cameras start this long before the swing
  double camera_tail = 0;   ///< [s] simulated, and stop this long after the predicted landing
  double scene_tail = 0;    ///< [s] simulated, the scene ends this long after the predicted landing
  double repeat_interval = 0;  ///< [s] wall time, an unanswered message is said again
  double answer_timeout = 0;   ///< [s] wall time without an answer until the experiment has failed
  double start_timeout = 0;    ///< [s] wall time until a started process must have said HEARTBEAT
  double listen_time = 0;      ///< [s] wall time, listening for another run before starting one
  double stop_grace = 0;       ///< [s] wall time from SIGINT to SIGKILL
  AimSettings adaptive;
};

/// @throw config::ConfigError
RunConfig loadRunConfig(const std::string& experiment_path);

}  // namespace fastball::launch
