#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace fastball::vision_tracker {

/// What the image of a ring would be over an area of a camera's image: for each pixel of the area
/// the share that the ring's tube covers, how it grows to the right and down [1/px], and the nearest
/// place of the ring.
struct RingTemplate {
  cv::Mat1f share, right, down;
  cv::Mat1f angle;     ///< [rad] of the ring; anything far from it
  cv::Mat1f distance;  ///< [px] to the middle of the tube; huge far from it
};

/// Draws one.
/// @param images [px] of points of the ring at equal angles, the first at 0; not empty
/// @param area [px] of the camera's image; what lies outside is cut off
/// @param width [px], of the tube @param blur [px], standard deviation of the image
/// @param reach [px] from the ring, beside tube and blur, within which the nearest place is known
RingTemplate ringTemplate(const std::vector<Eigen::Vector2d>& images,
                          const cv::Rect& area,
                          double width,
                          double blur,
                          double reach);

}  // namespace fastball::vision_tracker
