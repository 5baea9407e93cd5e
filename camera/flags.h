#pragma once

#include <optional>
#include <string>

#include "camera/node.h"
#include "messaging/clock.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

namespace fastball::camera {

/// The command line of the camera process; what it means: CameraOptions, DeviceOptions.
struct Flags {
  std::string device;  ///< path or number of a V4L2 camera, or empty
  std::string video;   ///< path of a file, or empty; one of the two must be given
  std::string channel = "CAMERA_LEFT";
  std::string calibration;  ///< path of a file, empty: none
  std::string size;         ///< "640x480" [px], empty: any
  int camera = 1;           ///< of those in the calibration file, from 1
  double rate = 0;          ///< [Hz]
  double exposure = 0;      ///< [s]
  double speed = 1;
  std::optional<int64_t> start_utime;  ///< [us]
  int quality = 90;
  bool gray = false, loop = false, on_request = false;
};

/// Adds all flags to the process's own.
void addFlags(CLI::App& app, Flags& flags);

/// What the flags ask for.
/// @throw std::invalid_argument in one sentence, if they contradict each other or name a bad file
CameraOptions optionsOf(const Flags& flags);
/// The source that flags ask for which optionsOf() has found good. `clock` must live as long as the
/// process (see Capture).
OpenSource sourceOf(const Flags& flags, const messaging::Clock& clock);

}  // namespace fastball::camera
