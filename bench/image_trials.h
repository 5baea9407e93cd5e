#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "config/experiment.h"
#include "sim_bullet/camera_config.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::bench {

/// A ball's centre as the tracker found it in a drawn image, against the truth.
struct CentreTrial {
  int camera = 0;
  int64_t utime = 0;                                ///< [us]
  Eigen::Vector2d error = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();    ///< [px^2], stated
  double radius_error = 0;                          ///< [px]
};

/// A throw from drawn images to its landing.
struct ImageTrial {
  int expected = 0;  ///< images that show the ball wholly, in free flight
  std::vector<CentreTrial> centres;
  vision_tracker::LandingReport report;
  Eigen::Vector2d landing_error = Eigen::Vector2d::Zero();  ///< [m]
  double normalised = 0;                                    ///< squared, by the stated covariance
  /// [m], error of the landing predicted 100 ms after the release; nothing if there was no prediction.
  std::optional<double> early_error;
  std::vector<double> image_seconds;  ///< processor time of decoding and tracking, of each image
  double landing_seconds = 0;         ///< wall time of the image after which the landing was there
  double duration = 0;                ///< [s], of the images
};

/// Draws a synthetic throw with the experiment's cameras (JPEG, noise, blur, the arm, the room) and gives the images to a tracker.
ImageTrial imageTrial(const sim_bullet::CameraRigOptions& cameras,
                      const config::Experiment& experiment,
                      const vision_tracker::TrackerOptions& tracker,
                      int seed);

}  // namespace fastball::bench
