#pragma once

#include <string>

#include "lcmtypes/fastball_types.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::vision_tracker {

/// The camera that a CAMERA_INFO speaks of, unchecked.
CameraSetup cameraSetup(const camera_info_t& message);

/// Why no camera can be like that (no rotation, no focal length, skew, ...), or an empty text. The
/// numbers of a message without a fault are small enough to compute with.
std::string cameraFault(const camera_info_t& message);

}  // namespace fastball::vision_tracker
