#include "vision_tracker/sphere_outline.h"

#include <Eigen/LU>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

/// How far [px] radial distortion moves the centroid of a disc of radius a around `n` (normalised coordinates) away from the
/// image of its middle, to second order in a: half the lens's second derivative over the disc's second moments, and the
/// change of its magnification across the disc. The lens maps n to n q(|n|^2).
Eigen::Vector2d lensShift(const model::Camera& camera, const Eigen::Vector2d& n, double a_squared) {
  const double s = n.squaredNorm(), k1 = camera.distortion[0], k2 = camera.distortion[1],
               k3 = camera.distortion[4];
  const double q = 1 + s * (k1 + s * (k2 + s * k3));
  const double q1 = k1 + s * (2 * k2 + s * 3 * k3);  // dq/ds
  const double q2 = 2 * k2 + s * 6 * k3;
  const double outward = q + 2 * q1 * s;
  const double area = q * outward, area1 = 4 * q * q1 + 2 * s * (q1 * q1 + q * q2);
  const double shift = a_squared * (q1 + q2 * s / 2 + area1 / (2 * area) * outward);
  return {camera.fx * shift * n.x(), camera.fy * shift * n.y()};
}

}  // namespace

double Outline::meanRadius() const {
  return std::sqrt(std::sqrt(shape.determinant()));
}

// The lines that touch the outline in the plane z = 1 form the dual conic c c^T - r^2 I (c: centre of the sphere in the camera
// frame); its last column is the ellipse's centre, (X Z, Y Z) / (Z^2 - r^2).
Eigen::Vector2d outlineCentre(const model::Camera& camera,
                              const Eigen::Vector3d& p_W,
                              double radius,
                              Eigen::Matrix<double, 2, 3>* jacobian) {
  const Eigen::Vector3d c = camera.toCamera(p_W);
  const double z = c.z(), root = z * z - radius * radius;
  // The point whose image is the ellipse's centre, at the sphere's depth.
  const double stretch = z * z / root;
  const Eigen::Vector3d q(stretch * c.x(), stretch * c.y(), z);
  const Eigen::Vector3d q_W = camera.R_CW.transpose() * (q - camera.p_CW);
  Eigen::Vector2d centre =
      camera.project(q_W, jacobian) + lensShift(camera, q.head<2>() / z, radius * radius / root);
  if (jacobian != nullptr) {
    const double stretch_z = -2 * z * radius * radius / (root * root);
    Eigen::Matrix3d dq_dc;
    dq_dc << stretch, 0, c.x() * stretch_z, 0, stretch, c.y() * stretch_z, 0, 0, 1;
    *jacobian = (*jacobian * camera.R_CW.transpose() * dq_dc * camera.R_CW).eval();
  }
  return centre;
}

Outline sphereOutline(const model::Camera& camera, const Eigen::Vector3d& p_W, double radius) {
  const Eigen::Vector3d c = camera.toCamera(p_W);
  const double root = c.z() * c.z() - radius * radius;
  const Eigen::Vector2d centre = c.head<2>() * c.z() / root;
  const Eigen::Matrix2d dual =
      (c.head<2>() * c.head<2>().transpose() - radius * radius * Eigen::Matrix2d::Identity()) /
      root;
  const Eigen::Matrix2d shape = centre * centre.transpose() - dual;
  // d pixel / d (x / z, y / z) at the ellipse's centre, from the projection of a point at depth 1.
  Eigen::Matrix<double, 2, 3> projection;
  const Eigen::Vector3d q_W =
      camera.R_CW.transpose() * (Eigen::Vector3d(centre.x(), centre.y(), 1) - camera.p_CW);
  Outline outline;
  outline.centre =
      camera.project(q_W, &projection) + lensShift(camera, centre, radius * radius / root);
  const Eigen::Matrix2d lens = (projection * camera.R_CW.transpose()).leftCols<2>();
  outline.shape = lens * shape * lens.transpose();
  return outline;
}

std::optional<SizedPlace> placeBySize(const model::Camera& camera,
                                      const Eigen::Vector2d& centre,
                                      double mean_radius,
                                      double radius) {
  const Eigen::Vector2d n = camera.undistort(centre);
  const auto placed = [&](double depth) -> Eigen::Vector3d {
    return camera.R_CW.transpose() * (depth * Eigen::Vector3d(n.x(), n.y(), 1) - camera.p_CW);
  };
  // Begin with the pinhole's depth, then scale it by what the outline there is too large.
  double depth = std::sqrt(camera.fx * camera.fy) * radius / mean_radius;
  if (!(depth > 3 * radius))
    return std::nullopt;
  depth *= sphereOutline(camera, placed(depth), radius).meanRadius() / mean_radius;
  return SizedPlace{placed(depth),
                    (camera.R_CW.transpose() * Eigen::Vector3d(n.x(), n.y(), 1)).normalized(),
                    depth};
}

}  // namespace fastball::vision_tracker
