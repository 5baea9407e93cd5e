#include "camera/device.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <stdexcept>

#include "camera/told_rate.h"

namespace fastball::camera {
namespace {

constexpr int64_t kOldestUs = 1'000'000;
constexpr double kManualExposure = 1;     // V4L2_EXPOSURE_MANUAL
constexpr double kExposureUnit = 100e-6;  // [s], of V4L2_CID_EXPOSURE_ABSOLUTE

}  // namespace

int64_t middleOfExposure(int64_t stamp_us, int64_t monotonic_us, int64_t wall_us, double exposure) {
  const int64_t half = std::llround(exposure / 2 * 1e6);
  const int64_t age = monotonic_us - stamp_us;
  const bool is_stamp = stamp_us > 0 && age >= 0 && age < kOldestUs;
  return is_stamp ? wall_us - age + half : wall_us - half;
}

Device::Device(DeviceOptions options, const messaging::Clock& clock)
    : options_(std::move(options)), clock_(clock) {
  try {
    capture_.open(options_.path, cv::CAP_V4L2);
  } catch (const cv::Exception&) {
    capture_.release();
  }
  if (!capture_.isOpened())
    throw std::runtime_error(fmt::format(
        "{}: cannot be opened as a V4L2 camera (it is none, another program holds it, or "
        "it may not be read)",
        options_.path));
  const auto ask = [&](int property, double value, const char* what) {
    if (!capture_.set(property, value))
      spdlog::warn("{}: does not take {}", options_.path, what);
  };
  // Uncompressed images do not fit through USB at high rates.
  ask(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), "MJPEG as its format");
  if (!options_.size.empty()) {
    ask(cv::CAP_PROP_FRAME_WIDTH, options_.size.width, "the width");
    ask(cv::CAP_PROP_FRAME_HEIGHT, options_.size.height, "the height");
  }
  if (options_.rate > 0)
    ask(cv::CAP_PROP_FPS, options_.rate, "the rate");
  if (options_.exposure > 0) {
    ask(cv::CAP_PROP_AUTO_EXPOSURE, kManualExposure, "manual exposure");
    ask(cv::CAP_PROP_EXPOSURE, options_.exposure / kExposureUnit, "the exposure");
  }
  rate_ = toldRate(capture_);
}

std::optional<SourceImage> Device::next() {
  SourceImage image;
  if (!capture_.read(image.pixels) || image.pixels.empty())
    throw std::runtime_error(fmt::format("{}: gives no images any more", options_.path));
  const double stamp_us = capture_.get(cv::CAP_PROP_POS_MSEC) * 1e3;
  const bool sensible = std::isfinite(stamp_us) && std::abs(stamp_us) < 1e18;
  image.utime = middleOfExposure(sensible ? std::llround(stamp_us) : 0, clock_.monotonicUs(),
                                 clock_.wallUs(), options_.exposure);
  return image;
}

}  // namespace fastball::camera
