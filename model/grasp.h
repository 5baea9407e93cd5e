#pragma once

#include <Eigen/Core>
#include <array>

#include "model/ball_parameters.h"
#include "model/hand.h"

namespace fastball::model {

/// One finger in the grasp; vectors in H.
struct FingerGrasp {
  Eigen::Vector3d n_H;     ///< contact normal, from the finger to the ball's centre
  Eigen::Vector3d p_H;     ///< [m], contact point: a - y from the ball's centre
  double force = 0;        ///< [N], normal
  double deformation = 0;  ///< y [m] of the ball under that force (Eq. 27)
  double distance = 0;  ///< [m], of the distal phalanx' axis from the z axis of H: a + r_finger - y
  Eigen::Vector3d torque;  ///< [N m], of the joints (spread, proximal, distal) that holds the force
};

/// The grasp of section 3.1: all distal phalanges parallel to z, the thumb presses with the grip
/// force and the two fingers behind the ball balance it. Weight and inertia of the ball are not
/// part of it.
struct GraspGeometry {
  std::array<FingerGrasp, kFingers> fingers;
  HandVector q = HandVector::Zero();  ///< joint angles of the hand, wrist at zero [rad]

  /// Distances of the distal axes [m], as Hand::posture() takes them.
  std::array<double, kFingers> distances() const {
    return {fingers[kFingerA].distance, fingers[kThumb].distance, fingers[kFingerB].distance};
  }
  /// Torques [N m] of all joints that press with the forces; those of the wrist are 0.
  HandVector torques() const;
};

/// @param grip_force normal force of the thumb [N], 0 or more.
/// @throw std::invalid_argument if the ball cannot carry the force, the ball does not lie on the z
/// axis of H, the fingers do not surround it, cannot reach it, or would touch it with anything but
/// their distal phalanges.
GraspGeometry grasp(const BallParameters& ball, const Hand& hand, double grip_force);

}  // namespace fastball::model
