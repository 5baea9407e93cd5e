#pragma once

#include <Eigen/Core>
#include <functional>

#include "model/ball_flight.h"
#include "model/ball_parameters.h"
#include "model/hand.h"
#include "model/hand_motion.h"
#include "model/hand_support.h"
#include "model/release_motion.h"

namespace fastball::model {

/// How the fingers let go.
struct ReleaseCommand {
  double grip_force = 0;  ///< [N], thumb normal force while gripping
  ReleaseMode mode = ReleaseMode::kAbrupt;
  ReleaseSettings settings;
  /// The fingers are exactly where they are told to be, and a thumb that opens abruptly is gone at once: the limit that theory
  /// speaks of.
  bool ideal_drives = false;
};

/// How the ball leaves a moving hand.
struct Departure {
  bool departed = false;  ///< false: still touched at the end of the time looked at
  double time =
      0;  ///< [s] after the command, last touch; negative if the swing lost the ball before
  BallState ball;                                     ///< at that time
  Eigen::Vector3d w_WBall = Eigen::Vector3d::Zero();  ///< [rad/s]
  /// [s] after the command, when the hand touches the ball again within the time looked at; negative: it does not.
  double touched_again = -1;
};

/// Integrates the ball between fingers and palm (Eq. 27 with damping and bristle friction, 3-D) and the fingers under their
/// drives, which are commanded once a millisecond as the hand server does, until nothing has touched the ball for 3 ms. It starts
/// 60 ms before the command at rest in the hand, so that all have found their balance under the grip, gravity and the hand's
/// acceleration when the fingers begin to let go.
/// @param hand_at the hand's planned motion t [s] after the command, asked for from t = -0.06 s on.
/// @param gravity [m/s^2], along -z of the world.
/// @param support what gives way when fingers and ball push the hand away from its plan; null: nothing.
/// @param time_step [s]. @param max_time [s] after the command: a ball that has not left by then
/// stays.
/// @param watch_time [s] after the departure, in which the ball is watched: whether finger or palm
/// touches it again.
/// @throw std::invalid_argument if the grip is more than the ball can carry or does not fit the hand (see grasp()), or if mass
/// or time step are not positive.
Departure predictDeparture(const BallParameters& ball,
                           const Hand& hand,
                           const ReleaseCommand& command,
                           const std::function<HandMotion(double)>& hand_at,
                           double gravity,
                           const HandSupport* support = nullptr,
                           double time_step = 1e-4,
                           double max_time = 0.1,
                           double watch_time = 0);

}  // namespace fastball::model
