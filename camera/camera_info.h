#pragma once

#include "lcmtypes/fastball_types.h"
#include "model/camera.h"

namespace fastball::camera {

/// A calibration as a message; time, channel, rate and exposure are for the caller to fill in.
camera_info_t infoMessage(const model::Camera& camera);

}  // namespace fastball::camera
