#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fastball::model {

/// The net's ring, and the plane in which landings are given: origin at its centre, first axis horizontal to the right seen
/// from the robot, second axis up in the plane.
struct Target {
  Eigen::Vector3d p_WTarget = Eigen::Vector3d::Zero();  ///< [m], centre of the ring
  Eigen::Vector3d n_WTarget =
      -Eigen::Vector3d::UnitX();  ///< unit normal, towards the robot; not vertical
  double radius = 0;              ///< [m], inner radius of the ring

  /// First axis of the plane: horizontal, to the right seen from the robot. With n = -x it is -y.
  Eigen::Vector3d rightAxis() const {
    return Eigen::Vector3d::UnitZ().cross(n_WTarget).normalized();
  }
  Eigen::Vector3d upAxis() const { return n_WTarget.cross(rightAxis()); }
  /// Plane coordinates [m] of a point (its distance from the plane is dropped).
  Eigen::Vector2d planeCoordinates(const Eigen::Vector3d& p_W) const {
    const Eigen::Vector3d p = p_W - p_WTarget;
    return {p.dot(rightAxis()), p.dot(upAxis())};
  }
  /// Distance [m] in front of the plane (towards the robot).
  double distance(const Eigen::Vector3d& p_W) const { return (p_W - p_WTarget).dot(n_WTarget); }
};

}  // namespace fastball::model
