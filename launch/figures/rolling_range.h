#pragma once

#include "model/hand_parameters.h"
#include "model/rolling_ball.h"

namespace fastball::launch {

/// A hand on a circle in a vertical plane, at its top and moving forwards at t = 0, when the grasping finger opens. Its push
/// fades: the acceleration along its path falls evenly from its first value to zero in the fade time and on below it.
struct CircleSwing {
  double speed = 6;         ///< [m/s], at t = 0
  double acceleration = 0;  ///< [m/s^2], along the path at t = 0
  double lean = 0;          ///< [rad], of the fingers out of the radius, forwards
  double radius = 1;        ///< [m]
  double fade_time = 0.04;  ///< [s]
  /// The frame of the fingers as the hand's.
  model::HandMotion operator()(double t) const;
  /// The same motion `factor` times as fast: the same path, so that accelerations grow with the square.
  CircleSwing faster(double factor) const;
};

/// How the ball leaves the fingers of a swing.
enum class RollKind { kForwards, kBackwards, kNone };
struct RollOutcome {
  RollKind kind = RollKind::
      kNone;  ///< towards the fingertips, towards the palm; none: gone as soon as the finger opens
  double distance = 0;  ///< x' [m] at the release
  double time = 0;      ///< [s], of the release
};
RollOutcome outcomeOf(const model::RollingMotion& motion);

/// x' [m] at which the ball has rolled from its nominal place to the fingertips.
double fingertipPastBall(const model::HandParameters& hand, double ball_radius);

}  // namespace fastball::launch
