#pragma once

#include <Eigen/Core>

#include "model/arm.h"

namespace fastball::model {

/// Rotation from DH frame i to frame i-1, RotZ(q) RotX(alpha), applied as two plane rotations.
struct Arm::Rotation {
  double cq, sq, ca, sa;

  /// From frame i to frame i-1.
  Eigen::Vector3d down(const Eigen::Vector3d& v) const {
    const double y = ca * v.y() - sa * v.z();
    return {cq * v.x() - sq * y, sq * v.x() + cq * y, sa * v.y() + ca * v.z()};
  }
  /// From frame i-1 to frame i.
  Eigen::Vector3d up(const Eigen::Vector3d& v) const {
    const double y = cq * v.y() - sq * v.x();
    return {cq * v.x() + sq * v.y(), ca * y + sa * v.z(), ca * v.z() - sa * y};
  }
  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d R;
    R << cq, -sq * ca, sq * sa, sq, cq * ca, -cq * sa, 0, sa, ca;
    return R;
  }
  /// R times the matrix, in place.
  void turn(Eigen::Matrix3d* R) const {
    const Eigen::Vector3d y = cq * R->col(1) - sq * R->col(0);
    const Eigen::Vector3d z = R->col(2);
    R->col(0) = cq * R->col(0) + sq * R->col(1);
    R->col(1) = ca * y + sa * z;
    R->col(2) = ca * z - sa * y;
  }
};

}  // namespace fastball::model
