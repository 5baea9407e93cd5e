#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "config/experiment.h"
#include "launch/throw_record.h"
#include "model/hand.h"

namespace fastball::launch {

/// Hand and ball at one tick, all in the world.
struct HandAndBall {
  double t = 0;  ///< [s] from the ball's departure
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  model::HandVector q = model::HandVector::Zero();                       ///< [rad]
  std::array<std::array<model::Segment, 2>, model::kFingers> phalanges;  ///< axes, [m]
  Eigen::Vector3d p_WBall = Eigen::Vector3d::Zero();                     ///< [m], centre
  /// [m], from the ball's surface to each finger's; negative: the finger presses the ball in.
  std::array<double, model::kFingers> gap{};
  double palm_gap = 0;  ///< [m], to the palm's disc
};

/// How a hand lets go of its ball, as a run's own senses tell it: ARM_STATE and HAND_STATE say where the hand is, RELEASE when
/// the ball left it. Until then the ball is where the hand holds it, p_HBall; from then on the tracker's last fit says where.
struct ReleaseSequence {
  std::vector<HandAndBall> ticks;  ///< in order, of 1 ms
  double t_swing = 0;              ///< [s], the swing begins, as planned; not before the first tick
  double t_command = 0;            ///< [s], the hand is told to let go
  double t_landing = 0;  ///< [s], the ball crosses the target plane; not after the last tick
  Eigen::Vector3d v_WBall = Eigen::Vector3d::Zero();  ///< [m/s], as it departs
  /// [m] in H: from where the hand holds the ball to where the tracker's fit has it at the departure. What the ball has rolled
  /// in the hand, and the errors of both.
  Eigen::Vector3d step_H = Eigen::Vector3d::Zero();

  /// The tick nearest to t [s].
  const HandAndBall& at(double t) const;
};

/// How far a hand has opened and the ball has left it.
struct Opening {
  double way_out = 0;  ///< [m], of the ball's centre from where the hand held it
  model::Finger nearest = model::kFingerA;
  double gap = 0;  ///< [m], from that finger to the ball
  /// [rad], by which each finger's proximal joint has closed since the command; negative: opened.
  std::array<double, model::kFingers> closed{};
};

/// At the tick nearest to t [s]. @param p_HBall [m], where the hand holds the ball.
Opening openingAt(const ReleaseSequence& sequence, double t, const Eigen::Vector3d& p_HBall);

/// Smallest distance [m] between the ball and any finger or the palm, from t_first to t_last [s].
double smallestGap(const ReleaseSequence& sequence, double t_first, double t_last);

/// @throw std::runtime_error if the throw's messages do not suffice: says which is missing.
ReleaseSequence releaseSequence(const ThrowRecord& record, const config::Experiment& experiment);

}  // namespace fastball::launch
