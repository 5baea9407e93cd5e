#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/background.h"
#include "vision_tracker/ball_fit.h"

namespace fastball::vision_tracker {

/// What the detector takes for a ball.
struct DetectorOptions {
  double ball_radius = 0;            ///< [m]
  double nearest = 0, farthest = 0;  ///< [m], the ball's depth before a camera
  double blur = 0;                   ///< [px], standard deviation of lens and pixel together
  /// [px], standard deviation per axis that the fit's own covariance does not know of; its square
  /// is added to the variances of centre and radius.
  double noise_floor = 0;
  /// [grey levels], of the ball's middle: what is known of its brightness. The whole range assumes nothing.
  double darkest = 0, brightest = 255;
  /// search() also gives round things on which no matt ball fits (patterned, shiny, smeared), with the centre of their area.
  bool keep_uneven = false;
};

/// Finds the ball in the images of one camera: CV_8U, of the camera's size, with a background that
/// has learned from at least one of them. Nothing here remembers an image.
class BallDetector {
 public:
  /// @param exposure [s]
  BallDetector(const model::Camera& camera, double exposure, const DetectorOptions& options);

  /// Ball-like round things anywhere in the image, the roundest first, at most four.
  std::vector<BallFit> search(const cv::Mat& image, const Background& background) const;
  /// The ball where it is expected: at p_WBall [m], +-`uncertainty` [px], with velocity v_WBall
  /// [m/s] (for the blur of the exposure). A fit that has not converged means that it is not there.
  BallFit at(const cv::Mat& image,
             const Background& background,
             const Eigen::Vector3d& p_WBall,
             const Eigen::Vector3d& v_WBall,
             double uncertainty) const;
  /// The rectangle [px] of the image that a ball at p_WBall [m] may touch; empty: it is not seen.
  cv::Rect area(const Eigen::Vector3d& p_WBall) const;

 private:
  BallFit accepted(BallFit fit,
                   const cv::Mat& image,
                   double expected_radius,
                   double tolerance,
                   double noise) const;
  bool hasBrightness(const BallFit& fit, const cv::Mat& image) const;

  model::Camera camera_;
  double exposure_;
  DetectorOptions options_;
};

}  // namespace fastball::vision_tracker
