#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/arm.h"

namespace fastball::launch {

/// How the joints of a throw move in time.
enum class Timing {
  /// Base functions sin, exp, sin of Eq. (12) on the analogous model, joint 2 of the arm held.
  kKineticChain,
  /// Joints 1, 3, 4 of the arm by one sine: the same start, end and shape; joint 2 held.
  kInPhaseHeld,
  kInPhaseFree  ///< all four joints by one sine
};

/// What bounds a throw, whatever its timing.
struct BudgetSettings {
  Eigen::Vector3d p_TBall = Eigen::Vector3d::Zero();  ///< [m], ball in the hand
  double omega_max = 0;                               ///< [rad/s, 1/s], of every base function
  double elbow_margin =
      0;  ///< [rad], |J4| at least, in the kinetic chain: its map to the arm is singular at 0
  double body_clearance = 0;  ///< [m], ball from the axis of the column, at least
  double lowest_ball = 0;     ///< [m], world z, at least
};

/// The fastest throw of one timing that was found with a share of the limits of torque.
struct BudgetPoint {
  double share = 0;          ///< of the limits of torque
  double release_speed = 0;  ///< [m/s], of the ball in the hand; 0: none found
  double duration = 0;       ///< [s], from rest to rest
};

/// The fastest release, wherever the ball flies, within the limits of position and speed and the
/// given shares of the limits of torque (friction, gravity and drives included), by SQP from random
/// starts for each share and from the throws of the neighbouring shares.
/// @param starts random starts with all the torque; with less, where basins are more, as many more.
std::vector<BudgetPoint> fastestByBudget(const model::Arm& arm,
                                         const BudgetSettings& settings,
                                         Timing timing,
                                         const std::vector<double>& shares,
                                         int starts,
                                         int64_t seed);

}  // namespace fastball::launch
