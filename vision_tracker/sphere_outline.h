#pragma once

#include <Eigen/Core>

#include "model/camera.h"

namespace fastball::vision_tracker {

/// The ellipse that a sphere's outline is in an image: (x - centre)^T shape^-1 (x - centre) = 1.
struct Outline {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();   ///< [px^2], positive definite
  /// [px], of the circle with the same area.
  double meanRadius() const;
};

/// Centre [px] (centroid of the area) of the outline of a sphere at p_W [m] of `radius` [m]. It is
/// not the image of the sphere's centre but lies farther out, by about r^2 / f tan(angle off the
/// axis), r and f in pixels, and the lens bends it a little more. Good to 0.005 px for a radius of
/// 10 px and the distortion of a common lens. `jacobian` (may be null): d centre / d p_W [px/m],
/// that of the little more left out. The sphere must lie wholly in front of the camera.
Eigen::Vector2d outlineCentre(const model::Camera& camera,
                              const Eigen::Vector3d& p_W,
                              double radius,
                              Eigen::Matrix<double, 2, 3>* jacobian = nullptr);

/// The whole outline, as above.
Outline sphereOutline(const model::Camera& camera, const Eigen::Vector3d& p_W, double radius);

}  // namespace fastball::vision_tracker
