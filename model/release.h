#pragma once

#include <Eigen/Core>
#include <functional>

#include "model/ball_flight.h"
#include "model/ball_parameters.h"
#include "model/hand.h"
#include "model/hand_parameters.h"

namespace fastball::model {

/// Pose, velocity and acceleration of the hand frame H in the world at one time.
struct HandMotion {
  Eigen::Isometry3d X_WH;
  Eigen::Vector3d v_WH, w_WH;   ///< [m/s] of H's origin, [rad/s]
  Eigen::Vector3d a_WH, dw_WH;  ///< [m/s^2], [rad/s^2]
};

/// How the fingers let go (section 3.1 i-iii): the thumb opens, the two fingers behind the ball stay where they are.
struct ReleaseCommand {
  double grip_force = 0;          ///< [N], thumb normal force while gripping
  double thumb_delay = 0;         ///< [s], from the command to the first motion of the thumb
  double thumb_acceleration = 0;  ///< [rad/s^2], of the thumb's opening
  double thumb_speed = 0;         ///< [rad/s], at most
  /// [N/m], of a finger behind the ball at its contact, in series with the ball; 0: rigid. Its drive carries the grip in its
  /// nominal place and gives way from there.
  double finger_stiffness = 0;
};

/// How the ball leaves a moving hand.
struct Departure {
  bool departed = false;  ///< false: still touched at the end of the time looked at
  double time =
      0;  ///< [s] after the command, last touch; negative if the swing lost the ball before
  BallState ball;                                     ///< at that time
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// Integrates the ball between fingers and palm (Eq. 27 with damping and bristle friction, 3-D) through the thumb's opening
/// until nothing has touched it for 3 ms. It starts 60 ms before the command at rest in the hand, so that it has found its
/// balance under the grip, gravity and the hand's acceleration when the thumb opens. Until then the thumb stays at its grasp
/// posture; the open thumb stops after a quarter turn.
/// @param hand_at the hand's motion t [s] after the command, asked for from t = -0.06 s on.
/// @throw std::invalid_argument if the grip is more than the ball can carry or does not fit the hand (see grasp()), or if mass
/// or time step are not positive.
Departure predictDeparture(const BallParameters& ball,
                           const Hand& hand,
                           const ReleaseCommand& command,
                           const std::function<HandMotion(double)>& hand_at,
                           double gravity,
                           double time_step = 1e-4,
                           double max_time = 0.1);

}  // namespace fastball::model
