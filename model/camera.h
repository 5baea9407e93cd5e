#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fastball::model {

/// Cameras of one experiment at most: a calibration file holds no more, and a flight is fitted to
/// the images of no more.
inline constexpr int kMostCameras = 4;

/// A pinhole camera with OpenCV's five distortion coefficients. Pixel centres lie at whole numbers.
struct Camera {
  int width = 0, height = 0;                                                     ///< [px]
  double fx = 0, fy = 0, cx = 0, cy = 0;                                         ///< [px]
  Eigen::Matrix<double, 5, 1> distortion = Eigen::Matrix<double, 5, 1>::Zero();  ///< k1 k2 p1 p2 k3
  Eigen::Matrix3d R_CW = Eigen::Matrix3d::Identity();  ///< camera frame: x right, y down, z ahead
  Eigen::Vector3d p_CW = Eigen::Vector3d::Zero();  ///< [m], origin of the world in the camera frame

  /// Point in the camera frame [m].
  Eigen::Vector3d toCamera(const Eigen::Vector3d& p_W) const { return R_CW * p_W + p_CW; }
  /// Pixel of a point in front of the camera (z > 0), distorted; `jacobian` (2x3, may be null) is d pixel / d p_W.
  Eigen::Vector2d project(const Eigen::Vector3d& p_W,
                          Eigen::Matrix<double, 2, 3>* jacobian = nullptr) const;
  /// Distorted pixel of normalised image coordinates (x/z, y/z).
  Eigen::Vector2d distort(const Eigen::Vector2d& normalised) const;
  /// Inverse of distort (iterated to 1e-10); the nearest it gets where the lens model has no inverse.
  Eigen::Vector2d undistort(const Eigen::Vector2d& pixel) const;
};

}  // namespace fastball::model
