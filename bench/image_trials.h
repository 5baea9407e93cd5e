#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bench/synthetic_throw.h"
#include "config/experiment.h"
#include "sim_bullet/camera_config.h"
#include "vision_tracker/sphere_outline.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::bench {

/// A throw, and the images that the experiment's cameras took of it.
struct DrawnThrow {
  SyntheticThrow made;
  std::vector<sim_bullet::RigCamera> cameras;
  std::vector<sim_bullet::RenderedImage> images;  ///< in order of time
  std::vector<bool> covered;  ///< images in which something else touches the ball; empty: none
};

/// Where the ball's outline truly is in an image, in the hand or in flight. @param radius [m]
vision_tracker::Outline trueOutline(const DrawnThrow& drawn,
                                    double radius,
                                    const sim_bullet::RenderedImage& image);

/// Draws a synthetic throw (JPEG, noise, blur, the arm, the room).
DrawnThrow drawThrow(const sim_bullet::CameraRigOptions& cameras,
                     const config::Experiment& experiment,
                     int seed);

/// What the tracker is told of the world.
struct Knowledge {
  std::vector<sim_bullet::RigCamera> cameras;
  model::Target target;
};

/// The truth, but for errors drawn from a seed: of each camera's calibration, and of the target's centre [m] and
/// normal [rad], per axis.
Knowledge wrongKnowledge(const DrawnThrow& drawn,
                         const model::Target& target,
                         const vision_tracker::CalibrationSigma& calibration,
                         double position,
                         double tilt,
                         int seed);

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
  int detected = 0;  ///< of these, with the ball among what the tracker found
  int images = 0;    ///< all, before the throw and after it too
  int wrong = 0;     ///< images in which it took something else for the ball that it tracked
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

/// Gives a drawn throw's images to a tracker.
ImageTrial imageTrial(const DrawnThrow& drawn,
                      const config::Experiment& experiment,
                      const vision_tracker::TrackerOptions& tracker,
                      const Knowledge& knowledge);

}  // namespace fastball::bench
