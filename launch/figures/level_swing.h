#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "model/arm_parameters.h"
#include "model/swing.h"
#include "model/swing_model.h"

namespace fastball::launch {

/// What joints 1 to 3 of the swing model may do.
struct SwingLimits {
  Eigen::Vector3d q_min, q_max;  ///< [rad]
  Eigen::Vector3d qd_max;        ///< [rad/s]
  Eigen::Vector3d tau_max;       ///< [N m]
  Eigen::Vector3d omega_max;     ///< [rad/s, 1/s, rad/s], of the base functions
};

/// Of the WAM's joints that do the same: joint 1 (azimuth of the upper arm), joint 2 (its polar
/// angle), joint 4 (elbow).
/// @param torque_share of its limits of torque.
SwingLimits levelSwingLimits(const model::ArmParameters& arm,
                             const Eigen::Vector3d& omega_max,
                             double torque_share);

/// Eq. (12): sin, exp, sin; the end effector is released at t = 0.
struct BaseSwing {
  model::SinBase q1;
  model::ExpBase q2;
  model::SinBase q3;
  model::SwingAngles at(double t) const;
  /// t_s and t_e [s] of Eq. (15), from Eq. (14) with the exp joint's phase counted from its change
  /// of sign.
  double start() const;
  double end() const;
};

struct LevelSwing {
  BaseSwing swing;
  double release_speed = 0;  ///< [m/s], 0: none found
  double torque_share = 0;   ///< largest share of a limit of torque that it needs
};

/// Eq. (15) for the first model (section 2.2), K_r the identity, joint 2 leaving the axis as Eq.
/// (7) drives it: the fastest release within the limits at all times from t_s to t_e, by SQP from
/// `starts` random starts. Of equally fast swings (each joint at its limit of speed) the one that
/// needs the least torque.
LevelSwing fastestLevelSwing(const model::LevelSwingModel& model,
                             const SwingLimits& limits,
                             int starts,
                             int64_t seed);

}  // namespace fastball::launch
