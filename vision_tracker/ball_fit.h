#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {

/// What is known of the ball's image before it is measured.
struct BallGuess {
  Outline outline;                                   ///< place and shape
  double radius_sigma = 0;                           ///< [px], how well its mean radius is known
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();  ///< [px], during the exposure
};

/// A ball measured in an image.
struct BallFit {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px], of the outline
  double radius = 0;                                 ///< [px], mean radius of the outline
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();     ///< [px^2], of the centre, from the residuals
  double radius_variance = 0;                        ///< [px^2], likewise
  double residual = 0;                               ///< [grey levels], rms
  double contrast = 0;     ///< [grey levels], mean difference from the background
  bool converged = false;  ///< else the rest means nothing
};

/// Fits a blurred disc of the guess's shape to the grey values: place, radius, blur, and for the
/// shading a lamp on a matt sphere plus a cubic polynomial of the place, over a background that is
/// known (Background::mean()). Levenberg-Marquardt with at most 20 steps. A contour or a centroid
/// would be drawn 0.2 to 1 px towards the lit side; a cubic alone 0.05 px away from the shadow.
/// @param image CV_8U
/// @param background of the same size, as Background::mean()
/// @param blur [px], standard deviation of lens and pixel together, to 30 %
/// @param noise [grey levels], standard deviation
/// @return not converged also where the ball of the guess is 2 px or less in radius, or does not
///   lie in the image with 4 px around it
BallFit fitBall(const cv::Mat& image,
                const cv::Mat& background,
                const BallGuess& guess,
                double blur,
                double noise);

}  // namespace fastball::vision_tracker
