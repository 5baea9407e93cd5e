#pragma once

#include <string>

namespace fastball::config {

/// Whether a channel of this name can carry a camera's images: CAMERA_ and capitals, digits or underscores, at most 64
/// characters; CAMERA_INFO carries calibrations.
inline bool isImageChannel(const std::string& name) {
  const std::string prefix = "CAMERA_";
  return name.size() > prefix.size() && name.size() <= 64 && name.rfind(prefix, 0) == 0 &&
         name != "CAMERA_INFO" &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
}

}  // namespace fastball::config
