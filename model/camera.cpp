#include "model/camera.h"

#include <Eigen/LU>
#include <cmath>

namespace fastball::model {
namespace {

/// OpenCV's distortion of normalised coordinates (radial k1 k2 k3, tangential p1 p2), and its
/// derivative.
Eigen::Vector2d distorted(const Eigen::Matrix<double, 5, 1>& d,
                          const Eigen::Vector2d& p,
                          Eigen::Matrix2d* derivative) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double k1 = d[0], k2 = d[1], p1 = d[2], p2 = d[3], k3 = d[4];
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (derivative != nullptr) {
    const double radial_r2 = k1 + r2 * (2 * k2 + r2 * 3 * k3);
    const double mixed = 2 * x * y * radial_r2 + 2 * p1 * x + 2 * p2 * y;
    *derivative << radial + 2 * x * x * radial_r2 + 2 * p1 * y + 6 * p2 * x, mixed, mixed,
        radial + 2 * y * y * radial_r2 + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Eigen::Vector2d Camera::project(const Eigen::Vector3d& p_W,
                                Eigen::Matrix<double, 2, 3>* jacobian) const {
  const Eigen::Vector3d p = toCamera(p_W);
  const Eigen::Vector2d normalised = p.head<2>() / p.z();
  if (jacobian == nullptr)
    return distort(normalised);
  Eigen::Matrix2d bending;
  const Eigen::Vector2d d = distorted(distortion, normalised, &bending);
  Eigen::Matrix<double, 2, 3> perspective;
  perspective << 1, 0, -normalised.x(), 0, 1, -normalised.y();
  *jacobian = Eigen::Vector2d(fx, fy).asDiagonal() * bending * (perspective / p.z()) * R_CW;
  return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& normalised) const {
  const Eigen::Vector2d d = distorted(distortion, normalised, nullptr);
  return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& pixel) const {
  constexpr double kAccuracy = 1e-10;
  const Eigen::Vector2d wanted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  Eigen::Vector2d p = wanted;
  Eigen::Matrix2d bending;
  Eigen::Vector2d error = distorted(distortion, p, &bending) - wanted;
  for (int i = 0; i < 50 && error.norm() > kAccuracy / 10; ++i) {
    // Newton's step, halved while it does not bring us nearer (far outside the image the lens model
    // folds over).
    const Eigen::Vector2d step = bending.inverse() * error;
    Eigen::Vector2d next_error = error;
    Eigen::Vector2d next = p;
    for (int halvings = 0; halvings < 14; ++halvings) {
      next = p - std::ldexp(1.0, -halvings) * step;
      next_error = distorted(distortion, next, &bending) - wanted;
      if (next_error.norm() < error.norm())
        break;
    }
    if (!(next_error.norm() < error.norm()))
      break;
    p = next;
    error = next_error;
  }
  return p;
}

}  // namespace fastball::model
