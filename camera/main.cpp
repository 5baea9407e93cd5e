#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "camera/flags.h"
#include "messaging/process.h"

int main(int argc, char** argv) {
  using namespace fastball;
  // What OpenCV says of a source that it cannot read is said again in one sentence.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  // A thread that hangs in its device may still look at the clock while the process ends.
  static const messaging::SystemClock device_clock;
  camera::Flags flags;
  return messaging::processMain(
      argc, argv, "fastball-camera",
      "Says the images of a V4L2 camera or of a video file, and their calibration.",
      [&](messaging::LcmEndpoint& endpoint, const messaging::Clock& clock,
          const messaging::ProcessOptions& /*options*/) {
        return camera::makeNode(endpoint, clock, camera::optionsOf(flags),
                                camera::sourceOf(flags, device_clock));
      },
      [&](CLI::App& app) { camera::addFlags(app, flags); });
}
