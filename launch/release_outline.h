#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/hand_parameters.h"

namespace fastball::launch {

/// The plane of a throw through the world's origin: that of the throw's level direction and the forearm when the ball leaves.
/// Looked at with the throw going to the right and the fingers pointing down.
class ThrowPlane {
 public:
  /// @param v_WBall [m/s]. @param X_WH the hand; its z axis is the forearm's.
  ThrowPlane(const Eigen::Vector3d& v_WBall, const Eigen::Isometry3d& X_WH);
  /// To the right and up [m].
  Eigen::Vector2d at(const Eigen::Vector3d& p_W) const;
  /// Distance [m] of a point behind the plane.
  double behind(const Eigen::Vector3d& p_W) const;

 private:
  Eigen::Vector3d right_, up_;
};

using Outline = std::vector<Eigen::Vector2d>;

/// [m], closed.
Outline circleOutline(const Eigen::Vector2d& centre, double radius);
/// What is seen of a capsule whose axis is seen from `start` to `end` [m], closed.
Outline capsuleOutline(const Eigen::Vector2d& start, const Eigen::Vector2d& end, double radius);
/// What is seen of the palm and the wrist that carries it [m]: a cylinder from the tool plate to
/// the palm's surface.
Outline palmOutline(const ThrowPlane& plane,
                    const Eigen::Isometry3d& X_WH,
                    const model::HandParameters& hand);

/// Data for gnuplot [m]: one polygon, seen from `origin`.
std::string polygon(const Outline& outline, const Eigen::Vector2d& origin);

}  // namespace fastball::launch
