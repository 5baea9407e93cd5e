#pragma once

#include <string>
#include <vector>

#include "config/experiment.h"
#include "model/release.h"
#include "planner/swing_problem.h"
#include "planner/whole_motion.h"
#include "planner/window_throw.h"

namespace fastball::planner {

/// Of throws through a release window.
struct RobustSettings {
  std::vector<double> window_lengths;  ///< [s], in the order in which they are tried
  double limit_share = 0;              ///< of speed and torque limits, used by the optimisation
  double wanted_speed = 0;             ///< [m/s], of the ball in the window: less is avoided
  ThrowErrors errors;
};

/// Targets for which throws are planned once and kept: horizontal distance from the arm's axis and world z.
struct AtlasSettings {
  Eigen::Vector2d distance = Eigen::Vector2d::Zero();  ///< [m], from and to
  Eigen::Vector2d height = Eigen::Vector2d::Zero();    ///< [m], from and to
  double step = 0;                                     ///< [m], between two of them
};

/// The planner's section of the experiment file, and what it needs of the shared part.
struct PlannerConfig {
  model::ArmParameters arm;
  model::HandParameters hand;
  model::BallParameters ball;
  SwingSettings swing;
  std::vector<Shoulder> shoulders;  ///< tried one after the other
  MotionSettings motion;
  double limit_share = 0;          ///< of speed and torque limits, used by the optimisation
  int random_starts = 0;           ///< where the stored ones find no throw
  int max_evaluations = 0;         ///< of each optimisation
  double landing_tolerance = 0;    ///< [m], predicted landing from the target's centre
  double floor = 0;                ///< [m], world z: a target below it is refused
  double grip_force = 0;           ///< [N], of the thumb, through the swing
  model::ReleaseSettings release;  ///< the hand server's
  model::SupportVector support_kp = model::SupportVector::Zero();  ///< [N m/rad], of arm and wrist
  model::SupportVector support_kd = model::SupportVector::Zero();  ///< [N m s/rad]
  RobustSettings robust;
  AtlasSettings atlas;
};

/// Reads the experiment file at `path`: the shared part, the section `planner`, and of
/// `hand_server` and `controller` what predicting them takes.
/// @throw config::ConfigError
PlannerConfig loadConfig(const std::string& path);

}  // namespace fastball::planner
