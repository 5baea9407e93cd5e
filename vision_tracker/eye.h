#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/background.h"
#include "vision_tracker/ball_detector.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// How a camera sees.
struct CameraSetup {
  model::Camera camera;
  double rate = 0;      ///< [Hz]
  double exposure = 0;  ///< [s]
};

/// Whether all numbers of two cameras are equal.
bool sameCamera(const CameraSetup& a, const CameraSetup& b);

/// One camera of a tracker and what it has learned of its view.
class Eye {
 public:
  Eye(const CameraSetup& setup, const DetectorOptions& options);
  /// Forgets every image.
  void reset();

  const CameraSetup& setup() const { return setup_; }
  const BallDetector& detector() const { return detector_; }
  const Background& background() const { return background_; }
  /// A fit of the ball as what it says of the flight.
  /// @param camera index of this one @param p_WBall [m], about where the ball is
  /// @param ball_radius [m]
  Observation observation(int64_t utime,
                          int camera,
                          const BallFit& fit,
                          const Eigen::Vector3d& p_WBall,
                          double ball_radius) const;
  /// Whether it has learned enough for foreground to mean anything.
  bool hasLearned() const;
  /// Learns the background from an image (CV_8U). @param leave [px], where the ball is
  /// @param following a ball whose way may be known
  void learn(const cv::Mat& image, const cv::Rect& leave, bool following);

  /// Where the ball is still to come, by some places [m] on its way; none of them: not known.
  void expectWay(const std::vector<Eigen::Vector3d>& places_W);
  bool knowsWay() const { return !way_.empty(); }

 private:
  CameraSetup setup_;
  BallDetector detector_;
  Background background_;
  cv::Rect way_ = {};  ///< [px], of the ball; the background of the rest no longer matters
  int followed_ = 0;   ///< images with such a way
};

}  // namespace fastball::vision_tracker
