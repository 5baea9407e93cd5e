#pragma once

#include "messaging/channels.h"

namespace fastball::messaging {

/// The images of a camera, whatever the name of its channel (config/image_channel.h), which must live as long as this is used.
inline Channel<image_t> imageChannel(const char* name) {
  return {name, kCameraLeft.max_bytes};
}

}  // namespace fastball::messaging
