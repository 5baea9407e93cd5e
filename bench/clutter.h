#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "bench/image_trials.h"
#include "sim_bullet/camera_config.h"

namespace fastball::bench {

/// What else moves and shines about a throw: a lamp that flickers on the wall, and a second ball which, throw by
/// throw, hangs on a string and swings, rolls over the floor, is carried by, or is thrown the other way.
class Clutter {
 public:
  Clutter(const sim_bullet::CameraRigOptions& rig, const config::Experiment& experiment);
  /// Draws it into a throw's images, nearer to the cameras than all else, and marks those in which it touches the ball.
  void addTo(DrawnThrow& drawn, int seed) const;

 private:
  sim_bullet::CameraRigOptions rig_;
  double ball_radius_, gravity_;
  std::vector<cv::Mat> rays_;
};

}  // namespace fastball::bench
