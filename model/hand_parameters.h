#pragma once

#include <Eigen/Core>
#include <array>

#include "model/arm_parameters.h"

namespace fastball::model {

inline constexpr int kHandJoints = 10;
inline constexpr int kFingers = 3;
/// Joint indices of the hand; fingers A and B stand behind the ball, the thumb in front of it.
enum HandJoint {
  kWristRoll,
  kWristFlexion,
  kSpreadA,
  kProximalA,
  kDistalA,
  kProximalThumb,
  kDistalThumb,
  kSpreadB,
  kProximalB,
  kDistalB
};
enum Finger { kFingerA, kThumb, kFingerB };

/// The three-finger hand; config/hand.yaml, with the source of every number there. Hand frame H: origin on the tool plate,
/// after both wrist joints; z along the forearm (the paper's x'), y the direction of the throw (the paper's y').
/// With both wrist joints at zero H is the tool frame T.
struct HandParameters {
  Eigen::Vector3d p_HBall = {0, 0, 0.15};  ///< [m], ball centre in the grasp
  double palm_distance = 0;                ///< [m], palm surface from the tool plate along z
  double palm_radius = 0;                  ///< [m], the palm is a disc of this radius
  RigidBody palm;                          ///< palm and wrist, in H
  double finger_mass = 0;                  ///< [kg], one finger; half in each phalanx
  /// [rad], of the fingers' bases about z of H, from x of H
  std::array<double, kFingers> azimuth{};
  double base_radius = 0;        ///< [m], of the finger bases from the z axis of H
  double base_distance = 0;      ///< [m], of the finger bases from the tool plate along z
  double proximal_length = 0;    ///< [m]
  double distal_length = 0;      ///< [m]
  double finger_radius = 0;      ///< [m], both phalanges are capsules
  double joint_inertia = 0;      ///< [kg m^2], of the drive at a finger joint
  double wrist_inertia = 0;      ///< [kg m^2], of the drive at a wrist joint
  double joint_speed_max = 0;    ///< [rad/s], fingers
  double finger_torque_max = 0;  ///< [N m]
  double wrist_torque_max = 0;   ///< [N m]
  double wrist_limit = 0;        ///< [rad], both ways
  double actuator_lag = 0;       ///< [s], first order, command to torque
  /// The hand with its ball as one rigid body, for the arm's dynamics: in the tool frame, wrist at zero.
  RigidBody payload;
};

}  // namespace fastball::model
