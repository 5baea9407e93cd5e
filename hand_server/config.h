#pragma once

#include <string>

#include "hand_server/opening_trial.h"
#include "model/release_motion.h"

namespace fastball::hand_server {

/// What lets the ball go.
enum class ReleaseBy {
  kPlanTime,    ///< the time that the plan names
  kNormalForce  ///< Eq. (24): the hand no longer pushes the ball
};

/// The section `hand_server` of an experiment file, where each number has its reason.
struct HandServerConfig {
  ReleaseBy release_by = ReleaseBy::kPlanTime;
  double normal_force_window =
      0;  ///< [s], before and after the planned release: Eq. (24) counts only there
  model::ReleaseSettings release;
  double grasp_time = 0;       ///< [s], to close the fingers on the ball, or to open them
  double settle_time = 0;      ///< [s], then the fingers even out their forces
  double settle_constant = 0;  ///< [s], how fast they do
  TrialSettings trial;         ///< of the opening, before the swing
  double clear_delay = 0;      ///< [s], after the command the fingers open at the latest
  double force_noise = 0;      ///< [N], standard deviation of the fingertips' force sensors
  double force_delay = 0;      ///< [s], from a force to its reading
  double command_shift_max =
      0;                   ///< [s], most by which a command comes earlier or later than planned
  double quiet_time = 0;   ///< [s] without touch after which the ball has left
  double grip_share = 0;   ///< of the planned grip that the thumb must feel before the swing
  double arm_bound = 0;    ///< [rad], the ball is kept if the arm is further from the plan
  double stale_limit = 0;  ///< [s], real time: the ball is kept if the robot is silent for longer
};

/// Reads the section `hand_server` of the experiment file at `path`.
/// @throw config::ConfigError
HandServerConfig loadConfig(const std::string& path);

}  // namespace fastball::hand_server
