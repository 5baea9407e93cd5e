#pragma once

#include <string>

#include "config/experiment.h"
#include "model/release.h"
#include "planner/swing_problem.h"
#include "planner/whole_motion.h"

namespace fastball::planner {

/// The planner's section of the experiment file, and what it needs of the shared part.
struct PlannerConfig {
  model::ArmParameters arm;
  model::HandParameters hand;
  model::BallParameters ball;
  SwingSettings swing;
  MotionSettings motion;
  double limit_share = 0;        ///< of speed and torque limits, used by the optimisation
  int random_starts = 0;         ///< beside the stored ones
  int max_evaluations = 0;       ///< of each optimisation
  double landing_tolerance = 0;  ///< [m], predicted landing from the target's centre
  model::ReleaseCommand release;
};

/// @throw config::ConfigError
PlannerConfig loadConfig(const std::string& path);

}  // namespace fastball::planner
