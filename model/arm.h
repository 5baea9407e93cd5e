#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "model/arm_parameters.h"

namespace fastball::model {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;
using Jacobian = Eigen::Matrix<double, 3, kArmJoints>;

// Defined in model/arm_derivatives.h.
struct TorqueDerivatives;
struct PointMotion;
struct DirectionMotion;

/// The 4-DOF WAM as rigid bodies in fixed-size Eigen: no function allocates or throws. Angles,
/// speeds and accelerations of joints are in [rad], [rad/s] and [rad/s^2] throughout. World W:
/// origin at the shoulder centre, x forward, y left, z up; zero pose: arm straight up. Tool frame
/// T: on the tool plate, axes of DH frame 4 (z along the forearm, away from the elbow).
class Arm {
 public:
  /// @param payload what the tool plate carries (hand and ball), in frame T.
  explicit Arm(const ArmParameters& parameters, const RigidBody& payload = {});

  const ArmParameters& parameters() const { return parameters_; }

  /// Pose of the tool frame.
  Eigen::Isometry3d X_WT(const Vector4& q) const;
  /// Pose of DH frame i = 1..4.
  Eigen::Isometry3d X_WLink(const Vector4& q, int i) const;
  /// Position [m] of the point P fixed in T at p_TP.
  Eigen::Vector3d p_WPoint(const Vector4& q, const Eigen::Vector3d& p_TP) const;
  /// Translational Jacobian [m] of that point: v_WP = J qd.
  Jacobian pointJacobian(const Vector4& q, const Eigen::Vector3d& p_TP) const;
  /// Rotational Jacobian of the tool frame: w_WT = J qd.
  Jacobian rotationJacobian(const Vector4& q) const;
  /// Acceleration [m/s^2] of that point: J qdd + dJ/dt qd.
  Eigen::Vector3d pointAcceleration(const Vector4& q,
                                    const Vector4& qd,
                                    const Vector4& qdd,
                                    const Eigen::Vector3d& p_TP) const;
  /// Position, velocity and acceleration of that point with their first derivatives.
  PointMotion pointMotion(const Vector4& q,
                          const Vector4& qd,
                          const Vector4& qdd,
                          const Eigen::Vector3d& p_TP) const;
  /// z of the tool frame with its first derivative.
  DirectionMotion toolAxis(const Vector4& q) const;

  /// Joint torques [N m] for a motion, Newton-Euler, drive inertia included, friction not.
  Vector4 inverseDynamics(const Vector4& q, const Vector4& qd, const Vector4& qdd) const;
  /// The same torques with their first derivatives.
  TorqueDerivatives inverseDynamicsDerivatives(const Vector4& q,
                                               const Vector4& qd,
                                               const Vector4& qdd) const;
  /// Joint torques [N m] that hold the arm still.
  Vector4 gravityTorque(const Vector4& q) const;
  /// Symmetric positive definite [kg m^2], drive inertia included.
  Matrix4 massMatrix(const Vector4& q) const;
  /// Joint accelerations [rad/s^2] under torques tau, without friction.
  Vector4 forwardDynamics(const Vector4& q, const Vector4& qd, const Vector4& tau) const;
  /// Friction torque [N m] that opposes qd: viscous + Coulomb smoothed by tanh(qd / 0.01 rad/s).
  Vector4 frictionTorque(const Vector4& qd) const;
  /// Derivative [N m s/rad] of each joint's friction torque by its own speed.
  Vector4 frictionSlope(const Vector4& qd) const;

  /// Largest ratio of speed to limit over joints and differential; 1 is at the limit.
  double speedRatio(const Vector4& qd) const;
  /// The same of torques [N m].
  double torqueRatio(const Vector4& tau) const;
  /// tau [N m] scaled into the limits: joints 1 and 4 clipped, the pair (2, 3) shrunk along its own
  /// direction.
  Vector4 clipTorque(const Vector4& tau) const;

 private:
  /// What does not change with the pose, all in DH frame i.
  struct Link {
    double cos_alpha = 1, sin_alpha = 0;
    Eigen::Vector3d axis;  ///< of joint i (z of frame i-1)
    Eigen::Vector3d p;     ///< [m], origin of frame i from that of frame i-1
    double mass = 0;       ///< [kg], the last link carries the payload
    Eigen::Vector3d h;     ///< [kg m], mass times centre of mass
    Eigen::Matrix3d I;     ///< [kg m^2], about the origin of frame i
  };
  struct Rotation;
  struct Frames;
  std::array<Rotation, kArmJoints> rotations(const Vector4& q) const;
  Frames frames(const Vector4& q) const;

  ArmParameters parameters_;
  std::array<Link, kArmJoints> links_;
};

}  // namespace fastball::model
