#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision_tracker/board_calibration.h"

namespace fastball::vision_tracker {

/// Where the board lies in one view: this makes the world's frame.
struct WorldBoard {
  std::string view;  ///< name of its images; empty: the first that the first camera can use
  /// Pose of the board (x right, y down, z into it, origin at the outer corner of its first square)
  /// in the world.
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< [m]
};

/// The images of one of several cameras.
struct CameraImages {
  std::string name;
  std::vector<BoardImage> images;
};

/// Several cameras calibrated together.
struct RigCalibration {
  std::vector<BoardCalibration> cameras;  ///< in the world
  /// [px], of the corners that two cameras see together, with the two cameras fixed to each other; the worst pair. 0 for one camera.
  double pair_rms = 0;
};

/// Each camera by itself, and then their poses, from the views that two of them share: images of one name were taken at the same
/// time, while all cameras stood still. Poses go from camera to camera along the pairs with the most views in common.
/// @throw std::invalid_argument for no camera; as calibrateFromBoard(), naming the camera; if a
///   camera shares fewer than three views with those that hang together already; or if the world's
///   view cannot be used
RigCalibration calibrateRig(const std::vector<CameraImages>& images,
                            const BoardShape& shape,
                            const WorldBoard& world);

}  // namespace fastball::vision_tracker
