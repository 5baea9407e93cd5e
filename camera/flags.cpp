#include "camera/flags.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "camera/device.h"
#include "camera/video_file.h"
#include "config/calibration_file.h"
#include "config/image_channel.h"

namespace fastball::camera {
namespace {

constexpr int kLargestSide = 8192;  // [px], of an image in a message

/// "0" is /dev/video0.
std::string devicePath(const std::string& name) {
  const bool number =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
  return number ? "/dev/video" + name : name;
}

cv::Size sizeOf(const std::string& text) {
  if (text.empty())
    return {};
  cv::Size size;
  char rest = 0;
  // Five digits cannot overflow.
  const int read = std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest);
  const auto good = [](int side) { return side >= 16 && side <= kLargestSide; };
  if (read != 2 || !good(size.width) || !good(size.height))
    throw std::invalid_argument(
        fmt::format("--size: '{}' is not WIDTHxHEIGHT with sides from 16 to {} px, such as 640x480",
                    text, kLargestSide));
  return size;
}

std::optional<model::Camera> calibrationOf(const Flags& flags) {
  if (flags.calibration.empty())
    return std::nullopt;
  const std::vector<model::Camera> cameras = config::readCalibration(flags.calibration);
  if (flags.camera < 1 || flags.camera > static_cast<int>(cameras.size()))
    throw std::invalid_argument(fmt::format("{}: has {} cameras, --camera asks for number {}",
                                            flags.calibration, cameras.size(), flags.camera));
  return cameras[static_cast<std::size_t>(flags.camera - 1)];
}

void requireConsistent(const Flags& flags) {
  if (flags.device.empty() == flags.video.empty())
    throw std::invalid_argument("give either --device or --video");
  if (!config::isImageChannel(flags.channel))
    throw std::invalid_argument(
        fmt::format("--channel: '{}' is no channel of images: CAMERA_ and capitals, digits or "
                    "underscores, not CAMERA_INFO",
                    flags.channel));
  if (flags.video.empty() &&
      (flags.loop || flags.on_request || flags.start_utime || flags.speed != 1))
    throw std::invalid_argument(
        "--loop, --on-request, --start-utime and --speed are for --video: a device has its own "
        "time");
  if (flags.loop && flags.on_request)
    throw std::invalid_argument("--loop and --on-request exclude each other");
  if (!flags.device.empty() && !std::filesystem::exists(devicePath(flags.device)))
    throw std::invalid_argument(
        fmt::format("--device: {} does not exist", devicePath(flags.device)));
}

}  // namespace

void addFlags(CLI::App& app, Flags& flags) {
  app.add_option("--device", flags.device,
                 "V4L2 camera: its path or number, such as 0 for /dev/video0");
  app.add_option("--video", flags.video, "Video file, instead of a camera")->option_text("FILE");
  app.add_option("--channel", flags.channel, "Channel of the images, CAMERA_...")
      ->capture_default_str();
  app.add_option(
         "--calib", flags.calibration,
         "Calibration, OpenCV YAML (fastball calibrate); without it there is no CAMERA_INFO")
      ->option_text("FILE");
  app.add_option("--camera", flags.camera, "Which camera of the calibration file, counted from 1")
      ->capture_default_str();
  app.add_option("--rate", flags.rate, "Images a second [Hz]; default: what the source tells")
      ->check(CLI::Range(0.1, 1e5));
  app.add_option("--exposure", flags.exposure,
                 "Exposure [s], asked of a device and told in CAMERA_INFO")
      ->check(CLI::Range(0.0, 0.9));
  app.add_option("--size", flags.size, "Size of the images [px]")->option_text("WIDTHxHEIGHT");
  app.add_flag("--gray", flags.gray, "Send images in grey: the tracker uses no colour");
  app.add_option("--quality", flags.quality,
                 "JPEG quality; less where an image would not fit a message")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_flag("--loop", flags.loop,
               "Begin the video again at its end, for ever; its time goes on");
  app.add_option("--speed", flags.speed, "Pace of the video; its time stamps stay what they are")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  app.add_option(
         "--start-utime", flags.start_utime,
         "Time stamp of the video's first image [us since 1970], which is said then if that "
         "time is still to come; the same for all cameras of a throw (default: now)")
      ->check(CLI::Range(int64_t{0}, int64_t{1} << 59));
  app.add_flag(
      "--on-request", flags.on_request,
      "Say the video once for each new PLAN_REQUEST, stamped from --start-utime (default 0) on: "
      "cameras that hear the same request agree without a common clock");
}

CameraOptions optionsOf(const Flags& flags) {
  requireConsistent(flags);
  CameraOptions options;
  options.video = !flags.video.empty();
  options.source = options.video ? flags.video : devicePath(flags.device);
  options.channel = flags.channel;
  options.calibration = calibrationOf(flags);
  options.size = sizeOf(flags.size);
  options.rate = flags.rate;
  options.exposure = flags.exposure;
  options.gray = flags.gray;
  options.quality = flags.quality;
  options.speed = flags.speed;
  options.start_utime = flags.start_utime;
  options.on_request = flags.on_request;
  return options;
}

OpenSource sourceOf(const Flags& flags, const messaging::Clock& clock) {
  if (!flags.video.empty())
    return
        [path = flags.video, loop = flags.loop] { return std::make_unique<VideoFile>(path, loop); };
  const DeviceOptions device{devicePath(flags.device), sizeOf(flags.size), flags.rate,
                             flags.exposure};
  return [device, &clock] { return std::make_unique<Device>(device, clock); };
}

}  // namespace fastball::camera
