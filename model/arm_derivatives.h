#pragma once

#include "model/arm.h"

namespace fastball::model {

/// Joint torques [N m] of a motion, with their first derivatives; row i is torque i.
struct TorqueDerivatives {
  Vector4 tau;        ///< as Arm::inverseDynamics gives it
  Matrix4 dtau_dq;    ///< [N m/rad]
  Matrix4 dtau_dqd;   ///< [N m s/rad]
  Matrix4 dtau_dqdd;  ///< [kg m^2], the mass matrix
};

/// Motion in W of a point P fixed in T, with its first derivatives.
struct PointMotion {
  Eigen::Vector3d p;  ///< [m]
  Eigen::Vector3d v;  ///< [m/s]
  Eigen::Vector3d a;  ///< [m/s^2]
  Jacobian J;         ///< [m], dp/dq = dv/dqd = da/dqdd
  Jacobian dv_dq;     ///< [m/s]
  Jacobian da_dq;     ///< [m/s^2]
  Jacobian da_dqd;    ///< [m/s], 2 dv_dq because v = J qd
};

/// A unit vector fixed in T, in W, with its first derivative.
struct DirectionMotion {
  Eigen::Vector3d e;
  Jacobian de_dq;
};

}  // namespace fastball::model
