#pragma once

#include <LinearMath/btMatrix3x3.h>
#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Between Bullet's types and Eigen's; both are double.
namespace fastball::sim_bullet {

inline btVector3 toBullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// The rotation as Bullet's quaternion.
inline btQuaternion toBullet(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

inline Eigen::Vector3d toEigen(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline Eigen::Matrix3d toEigen(const btMatrix3x3& R) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      result(row, col) = R[row][col];
  return result;
}

}  // namespace fastball::sim_bullet
