#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision_tracker/background.h"
#include "vision_tracker/ball_detector.h"

namespace fastball::vision_tracker {

/// The ball in one image of a video.
struct PixelSighting {
  int frame = 0;    ///< from 0
  double time = 0;  ///< [s]
  BallFit fit;
};

/// What a PixelTracker looks for.
struct PixelTrackerOptions {
  double smallest = 0, largest = 0;  ///< [px], radius of the ball
};

/// Follows a ball through the images of one camera that stands still, without any calibration: round things of the
/// right size that differ from the learned background are linked to paths, each predicted from its last three
/// places. A bounce ends a path and begins another.
class PixelTracker {
 public:
  PixelTracker(const cv::Size& size, const PixelTrackerOptions& options);

  /// The next image, CV_8U of the size given, at a time [s] after the last one's.
  void add(const cv::Mat& image, double time);

  /// The ball's paths in order of time, at most one sighting an image: where several things moved at a time, the
  /// one with the longer path is the ball. Paths of fewer than four sightings, or of less than two diameters from
  /// end to end, are none; nor are those of things of quite another size than the longest path's.
  std::vector<PixelSighting> track() const;

 private:
  struct Path {
    std::vector<PixelSighting> sightings;
  };
  Eigen::Vector2d predicted(const Path& path, double time) const;
  double gate(const Path& path, double time) const;
  bool extends(const Path& path, const BallFit& fit, double time, double& distance) const;

  PixelTrackerOptions options_;
  BallDetector detector_;
  Background background_;
  int frame_ = 0;
  std::vector<Path> open_, closed_;
};

}  // namespace fastball::vision_tracker
