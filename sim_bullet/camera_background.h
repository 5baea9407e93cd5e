#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "model/camera.h"
#include "model/target.h"
#include "sim_bullet/camera_config.h"

namespace fastball::sim_bullet {

/// For each pixel the direction (x/z, y/z, 1) in the camera frame that it looks into, lens distortion undone; CV_32FC2.
cv::Mat rayMap(const model::Camera& camera);

/// What stands still in front of a camera without the net: wall, floor, the robot's base; CV_8U.
cv::Mat drawRoom(const model::Camera& camera, const cv::Mat& rays);

/// The ring as straight pieces in the image, in pairs of points, with their depths.
struct RingPiece {
  Eigen::Vector2d start, end;  ///< [px]
  double depth = 0;            ///< [m], along the optical axis
  double width = 0;            ///< [px]
};
std::vector<RingPiece> ringPieces(const model::Camera& camera, const model::Target& target);
/// Draws one piece; `origin` is the image's own corner in the full image.
void drawRingPiece(const RingPiece& piece, const cv::Point& origin, cv::Mat& image);

/// Draws the ring with the bag behind it, as wide as they are and blurred by lens and pixel; CV_8U.
/// @param blur [px], standard deviation.
void drawNet(const model::Camera& camera, const model::Target& target, double blur, cv::Mat& image);

/// All that a camera needs to draw a frame; shared by the threads that draw, never changed.
struct View {
  RigCamera rig;
  cv::Mat rays;        ///< rayMap
  cv::Mat background;  ///< CV_8U, with the net
  std::vector<RingPiece> ring;
};

}  // namespace fastball::sim_bullet
