#pragma once

#include <optional>
#include <string>

#include "camera/node.h"
#include "messaging/clock.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

namespace fastball::camera {

/// The command line of the camera process.
struct Flags {
  std::string device, video, channel = "CAMERA_LEFT", calibration, size;
  int camera = 1;  ///< of those in the calibration file
  double rate = 0, exposure = 0, speed = 1;
  std::optional<int64_t> start_utime;
  int quality = 90;
  bool gray = false, loop = false, on_request = false;
};

/// Adds all flags to the process's own.
void addFlags(CLI::App& app, Flags& flags);

/// What the flags ask for. @throw std::invalid_argument in one sentence, if they contradict each other or name a bad file
CameraOptions optionsOf(const Flags& flags);
OpenSource sourceOf(const Flags& flags, const messaging::Clock& clock);

}  // namespace fastball::camera
