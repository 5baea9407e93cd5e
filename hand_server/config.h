#pragma once

#include <string>

#include "model/hand.h"

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
  model::HandVector kp = model::HandVector::Zero();  ///< [N m/rad], of the hand's servo
  model::HandVector kd = model::HandVector::Zero();  ///< [N m s/rad]
  double open_distance = 0;       ///< [m], of the open fingers' distal axes from the z axis of H
  double grasp_time = 0;          ///< [s], to close the fingers on the ball
  double thumb_open_angle = 0;    ///< [rad], proximal joint of the open thumb
  double thumb_speed = 0;         ///< [rad/s], at which the opening thumb is pushed no further
  double thumb_deceleration = 0;  ///< [rad/s^2], at the end of its way
  double clear_delay = 0;         ///< [s], after the release the fingers open at the latest
  double clear_time = 0;          ///< [s], the fingers take to open
  double touch_force = 0;         ///< [N], less counts as no touch
  double quiet_time = 0;          ///< [s] without touch after which the ball has left
  double grip_share = 0;          ///< of the planned grip that the thumb must feel before the swing
  double arm_bound = 0;           ///< [rad], the ball is kept if the arm is further from the plan
};

/// Reads the section `hand_server` of the experiment file at `path`.
/// @throw config::ConfigError
HandServerConfig loadConfig(const std::string& path);

}  // namespace fastball::hand_server
