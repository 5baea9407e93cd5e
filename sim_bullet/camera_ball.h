#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "sim_bullet/camera_background.h"
#include "sim_bullet/snapshot.h"

namespace fastball::sim_bullet {

/// How the ball looks.
struct BallLook {
  double radius = 0;                                      ///< [m]
  double blur = 0;                                        ///< [px], standard deviation
  Eigen::Vector3d to_light_W = Eigen::Vector3d::UnitZ();  ///< unit vector
};

/// A rectangle that holds the ball's outline and its blur; empty if the ball is not in front of the camera.
cv::Rect ballBounds(const model::Camera& camera,
                    const Eigen::Vector3d& p_WBall,
                    const BallLook& look);

/// Draws the ball by asking of each pixel's ray how it passes the sphere, so that the outline is the true one: a cone's section,
/// bent by the lens. `origin` is the image's own corner in the full image; CV_8U.
void drawBall(const View& view,
              const SceneSnapshot& snapshot,
              const BallLook& look,
              const cv::Point& origin,
              cv::Mat& image);

}  // namespace fastball::sim_bullet
