#pragma once

#include <Eigen/Geometry>

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::hand_server {

/// Acceleration of the hand's point where the ball is held less that of gravity [m/s^2], in H.
/// @param X_TH pose of the hand in the tool frame. @param p_HBall [m], ball centre in the hand.
Eigen::Vector3d carryingAcceleration(const model::Arm& arm,
                                     const model::ArmMotion& motion,
                                     const Eigen::Isometry3d& X_TH,
                                     const Eigen::Vector3d& p_HBall);

/// How hard the hand pushes the ball along the direction of the throw, as an acceleration: alpha'_0y - g'_y of Eq. (24)
/// [m/s^2], of the hand's point where the ball is held. Negative: only the thumb keeps the ball in the hand.
double pushingAcceleration(const model::Arm& arm,
                           const model::ArmMotion& motion,
                           const Eigen::Isometry3d& X_TH,
                           const Eigen::Vector3d& p_HBall);

/// Finds the moment at which the hand stops pushing: true at the first call with a negative value after a positive one.
class PushEnd {
 public:
  bool reached(double pushing_acceleration) {
    has_pushed_ = has_pushed_ || pushing_acceleration > 0;
    return has_pushed_ && pushing_acceleration < 0;
  }

 private:
  bool has_pushed_ = false;
};

}  // namespace fastball::hand_server
