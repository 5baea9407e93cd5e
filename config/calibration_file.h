#pragma once

#include <string>
#include <vector>

#include "model/camera.h"

namespace fastball::config {

/// Cameras from a calibration file as OpenCV writes it (YAML, XML or JSON of cv::FileStorage). One camera at the top level:
///   image_width, image_height      [px]
///   camera_matrix                  3x3 [px]
///   distortion_coefficients        4 or 5 numbers: k1 k2 p1 p2 k3
///   R, T                           3x3 or a rotation vector; 3 numbers [m]: p_C = R p_W + T. Both may be missing: the world is
///                                  then the camera's own frame.
/// or up to model::kMostCameras such maps in a list `cameras`.
/// @throw std::invalid_argument naming file and key, if anything is missing or cannot be a camera's
std::vector<model::Camera> readCalibration(const std::string& path);

/// Writes such a file; what readCalibration() reads from it is the same to the last digit but for rounding in R.
/// @throw std::invalid_argument if it cannot be written
void writeCalibration(const std::string& path, const std::vector<model::Camera>& cameras);

}  // namespace fastball::config
