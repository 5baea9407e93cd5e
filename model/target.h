#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fastball::model {

/// The net's ring, and the plane in which landings are given: origin at its centre, first axis to the right seen
/// from the robot (horizontal, but in a ring that lies nearly flat), second axis square to it. The second axis
/// points up in a ring that faces the robot, and away from the robot in one that faces up.
struct Target {
  Eigen::Vector3d p_WTarget = Eigen::Vector3d::Zero();  ///< [m], centre of the ring
  Eigen::Vector3d n_WTarget =
      -Eigen::Vector3d::UnitX();  ///< unit normal of its front: the ball shall come from there
  double radius = 0;              ///< [m], inner radius of the ring

  /// First axis of the plane. With n = -x it is -y.
  Eigen::Vector3d rightAxis() const {
    constexpr double kFlat = 0.05;  // horizontal part of the normal
    const bool overhead = p_WTarget.head<2>().isZero();
    const Eigen::Vector3d right(overhead ? 0 : p_WTarget.y(), overhead ? -1 : -p_WTarget.x(), 0);
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(n_WTarget);
    if (level.squaredNorm() < kFlat * kFlat)
      return (right - right.dot(n_WTarget) * n_WTarget).normalized();
    return (level.dot(right) < 0 ? -level : level).normalized();
  }
  /// Second axis of the plane; right x up = n.
  Eigen::Vector3d upAxis() const { return n_WTarget.cross(rightAxis()); }
  /// Plane coordinates [m] of a point (its distance from the plane is dropped).
  Eigen::Vector2d planeCoordinates(const Eigen::Vector3d& p_W) const {
    const Eigen::Vector3d p = p_W - p_WTarget;
    return {p.dot(rightAxis()), p.dot(upAxis())};
  }
  /// Distance [m] in front of the plane.
  double distance(const Eigen::Vector3d& p_W) const { return (p_W - p_WTarget).dot(n_WTarget); }
};

}  // namespace fastball::model
