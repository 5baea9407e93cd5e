#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fastball::model {

/// Pose, velocity and acceleration of the hand frame H in the world at one time.
struct HandMotion {
  Eigen::Isometry3d X_WH;
  Eigen::Vector3d v_WH, w_WH;   ///< [m/s] of H's origin, [rad/s]
  Eigen::Vector3d a_WH, dw_WH;  ///< [m/s^2], [rad/s^2]
};

/// Velocity [m/s] of the hand's material point at p_W.
inline Eigen::Vector3d pointVelocity(const HandMotion& hand, const Eigen::Vector3d& p_W) {
  return hand.v_WH + hand.w_WH.cross(p_W - hand.X_WH.translation());
}

}  // namespace fastball::model
