#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace fastball::model {

inline constexpr int kArmJoints = 4;

/// Mass, centre of mass and inertia of a rigid body, all in one frame B fixed to it.
struct RigidBody {
  double mass = 0;                                   ///< [kg]
  Eigen::Vector3d p_BCom = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Matrix3d I_BCom =
      Eigen::Matrix3d::Zero();  ///< [kg m^2], true tensor about the centre of mass, axes of B
};

/// One row of the standard (Spong) Denavit-Hartenberg table: T = RotZ(q) TransZ(d) TransX(a)
/// RotX(alpha).
struct DhRow {
  double a = 0;      ///< [m]
  double alpha = 0;  ///< [rad]
  double d = 0;      ///< [m]
};

/// The WAM as config/arm/*.yaml gives it, with the source of every number there.
struct ArmParameters {
  std::string profile;  ///< "wam4-48v", ...; every result names it
  std::array<DhRow, kArmJoints> dh;
  std::array<RigidBody, kArmJoints> links;  ///< link i in DH frame i
  double tool_plate_distance = 0;           ///< [m] from DH frame 4 along its z
  Eigen::Vector4d drive_inertia =
      Eigen::Vector4d::Zero();   ///< [kg m^2] at the joints, on the diagonal of M
  Eigen::Vector4d q_min, q_max;  ///< [rad], mechanical stops
  double position_margin = 0;    ///< [rad], plans keep this distance from the stops
  Eigen::Vector4d qd_max;        ///< [rad/s]
  Eigen::Vector4d tau_max;       ///< [N m], one joint at a time
  /// Joint 2 and 3 share motors through a cable differential: |qd2| / qd_max2 + |qd3| / qd_max3 <=
  /// 1, the same for torque.
  bool differential = true;
  Eigen::Vector4d viscous_friction = Eigen::Vector4d::Zero();  ///< [N m s/rad]
  Eigen::Vector4d coulomb_friction = Eigen::Vector4d::Zero();  ///< [N m]
  double gravity = 9.81;                                       ///< [m/s^2], along -z of the world
};

}  // namespace fastball::model
