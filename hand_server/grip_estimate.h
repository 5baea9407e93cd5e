#pragma once

#include <Eigen/Core>
#include <optional>

#include "hand_server/hand_sample.h"
#include "model/ball_parameters.h"
#include "model/hand.h"

namespace fastball::hand_server {

/// How the ball lies in the hand, as the fingers feel it.
struct GripEstimate {
  double grip_force = 0;                              ///< [N], of the thumb
  Eigen::Vector3d p_HBall = Eigen::Vector3d::Zero();  ///< [m], ball centre
  double youngs_modulus = 0;                          ///< E [Pa]
};

/// Feels how the ball lies in the hand at rest. The joint angles say where the three fingers are, and Eq. (27) how deep a force
/// presses a finger into the ball:
///     y(F_i; E) = a + r_finger - |p - (axis of finger i)|,   i = finger A, thumb, finger B,
/// three equations for E and the place p of the ball across the fingers; its radius a is known. How far out along the fingers
/// the ball lies, the torques of the distal joints say: the forces' levers, and the phalanges' own weight.
/// Forces, angles and torques are averaged with a time constant of 20 ms. No function allocates.
class GripFeeling {
 public:
  /// Takes a state of the hand at rest, dt [s] after the one before.
  void step(const HandSample& sample, double dt);
  /// Nothing if a finger does not feel the ball or the equations have no sensible solution.
  /// @param ball its radius counts; its E is where the search begins. @param g_H gravity [m/s^2] in the hand frame.
  std::optional<GripEstimate> estimate(const model::Hand& hand,
                                       const model::BallParameters& ball,
                                       const Eigen::Vector3d& g_H) const;

 private:
  double placeAlongFingers(const model::Hand& hand,
                           const model::BallParameters& ball,
                           const Eigen::Vector2d& across,
                           const Eigen::Vector3d& g_H) const;

  bool begun_ = false;
  model::HandVector q_ = model::HandVector::Zero();
  model::HandVector tau_ = model::HandVector::Zero();  ///< [N m]
  FingerForces force_{}, along_{};                     ///< [N], normal and along z of H
};

}  // namespace fastball::hand_server
