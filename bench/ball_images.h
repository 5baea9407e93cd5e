#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "model/camera.h"
#include "vision_tracker/ball_detector.h"

namespace fastball::bench {

/// A matt ball before clutter, lit from one side, as a camera sees it.
struct BallImageOptions {
  double radius = 8;     ///< [px]
  double contrast = 20;  ///< [grey levels], of the ball's dark side from the lightest clutter
  double lamp = 100;     ///< [grey levels], what the lamp adds where it shines straight on
  double blur = 0.6;     ///< [px], standard deviation of lens and pixel together
  double motion = 1.0;   ///< [px], during the exposure
  double noise = 2.0;    ///< [grey levels], standard deviation
  int jpeg_quality = 80;
};

/// The ball's centre as a detector finds it, against the truth.
struct BallImageTrial {
  bool found = false;
  Eigen::Vector2d error = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Vector2d light = Eigen::Vector2d::Zero();  ///< where in the image the light comes from
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();    ///< [px^2], stated
};

/// Draws images by 5 x 5 rays a pixel (cosine law, the limb and its foreshortening included), blurs by the lens before the pixels
/// sum, moves the ball during the exposure, adds noise, compresses; lets the detector learn the empty scene and find the ball.
/// Place, light, motion and clutter are drawn from the seed. Shares nothing with the simulator's drawing.
BallImageTrial ballImageTrial(const BallImageOptions& options, int seed);

}  // namespace fastball::bench
