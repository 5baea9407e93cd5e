#pragma once

#include <string>
#include <vector>

#include "vision_tracker/throw_tracker.h"

namespace fastball::vision_tracker {

/// The tracker's options from an experiment file: its section `tracker`, and the ball and gravity of the shared part.
struct TrackerConfig {
  TrackerOptions tracker;
  std::vector<std::string> cameras;  ///< channels of their images, one to four, all different
  double longest_wait = 0;           ///< [s], from a throw's first image to its landing
  double silence = 0;  ///< [s] of wall time without an image after which the images have ended
};

/// @param path of the experiment file
/// @throw config::ConfigError
TrackerConfig readTracker(const std::string& path);

}  // namespace fastball::vision_tracker
