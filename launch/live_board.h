#pragma once

#include <string>
#include <vector>

#include "vision_tracker/board_corners.h"
#include "vision_tracker/rig_calibration.h"

namespace fastball::launch {

/// Views of a board from cameras that run.
struct LiveBoard {
  std::string lcm_url;
  std::vector<std::string> channels;  ///< of the cameras' images
  vision_tracker::BoardShape shape;
  std::size_t views = 0;  ///< of each camera, that are enough
  std::string folder;     ///< every view is kept there, in a folder for each camera
};

/// Collects views until each camera has enough, or SIGINT; says its progress on standard output.
/// @throw std::invalid_argument if the board cannot be, the folder cannot be written or the URL
///   does not parse
/// @throw std::runtime_error if a camera says nothing for ten seconds or the network cannot be used
std::vector<vision_tracker::CameraImages> collectViews(const LiveBoard& options);

}  // namespace fastball::launch
