#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/board_corners.h"

namespace fastball::vision_tracker {

/// An image of the board.
struct BoardImage {
  std::string name;
  cv::Mat grey;  ///< CV_8U
};

/// What one image gave.
struct BoardView {
  std::string name;
  BoardCorners corners;
  double rms = 0;  ///< [px], of its residuals; 0 if it was not used
  bool used = false;
  Eigen::Matrix3d R_CB =
      Eigen::Matrix3d::Identity();  ///< board (x right, y down, z into it) to camera
  /// [m], the board's origin, the outer corner of its first square.
  Eigen::Vector3d p_CB = Eigen::Vector3d::Zero();
};

/// A camera calibrated.
struct BoardCalibration {
  model::Camera camera;     ///< in the frame of the camera itself
  double rms = 0;           ///< [px]
  double focal_sigma = 0;   ///< [px], standard deviation of fx by the residuals
  double centre_sigma = 0;  ///< [px], of the principal point, the larger of both axes
  std::vector<BoardView> views;
  cv::Mat picture;  ///< CV_8UC3, residuals of all corners, 100 times as long
};

/// Intrinsics and distortion from images of a board (Z. Zhang, "A Flexible New Technique for Camera
/// Calibration", 2000, as OpenCV's calibrateCamera has it).
/// @throw std::invalid_argument if the board cannot be, the images differ in size, fewer than eight
///   show at least eight corners, all show the board from the same direction to 15 degrees (then
///   focal length and distance cannot be told apart), or the corners lie in less than 30 % of the
///   image
BoardCalibration calibrateFromBoard(const std::vector<BoardImage>& images, const BoardShape& shape);

}  // namespace fastball::vision_tracker
