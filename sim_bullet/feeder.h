#pragma once

#include <Eigen/Core>

#include "sim_bullet/ball_contact.h"
#include "sim_bullet/world.h"

namespace fastball::sim_bullet {

/// Holds the ball in the hand until the fingers do: a spring and a damper, for place and orientation, between the
/// ball and a point of the hand. What it does to the ball it does to the hand with the opposite sign.
class Feeder {
 public:
  /// @param p_HBall where it holds the ball [m]. @param frequency of the ball on the spring [rad/s].
  Feeder(const Eigen::Vector3d& p_HBall, const model::BallParameters& ball, double frequency);

  /// The ball at rest relative to the hand at its place.
  BallMotion rest(const ArmHand& hand) const;
  /// Wrench on the ball for the coming step; the reaction goes to the hand.
  Wrench step(ArmHand& hand, const BallMotion& ball) const;

 private:
  Eigen::Vector3d p_HBall_;
  double stiffness_, damping_;                  ///< [N/m], [N s/m]
  double turning_stiffness_, turning_damping_;  ///< [N m/rad], [N m s/rad]
};

}  // namespace fastball::sim_bullet
