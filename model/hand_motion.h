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

}  // namespace fastball::model
