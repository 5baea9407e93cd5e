#pragma once

#include <opencv2/videoio.hpp>
#include <string>

#include "camera/image_source.h"
#include "messaging/clock.h"

namespace fastball::camera {

/// What is asked of a device; 0: whatever it does by itself.
struct DeviceOptions {
  std::string path;     ///< e.g. /dev/video0
  cv::Size size;        ///< [px]
  double rate = 0;      ///< [Hz]
  double exposure = 0;  ///< [s]
};

/// When the middle of an exposure was, by the driver's time stamp. V4L2 stamps buffers with the monotonic clock, UVC cameras' when
/// the exposure begins. A stamp that does not lie in the second before now is none; then the image is taken to have ended just now.
/// @param stamp_us, monotonic_us [us] of the same monotonic clock
/// @param wall_us [us since 1970], at the same moment as monotonic_us
/// @param exposure [s]
/// @return [us since 1970]
int64_t middleOfExposure(int64_t stamp_us, int64_t monotonic_us, int64_t wall_us, double exposure);

/// A V4L2 device through OpenCV, asked for MJPEG. What else it does not do as asked is a warning in
/// the log.
class Device : public ImageSource {
 public:
  /// @param clock must live as long
  /// @throw std::runtime_error if it cannot be opened
  Device(DeviceOptions options, const messaging::Clock& clock);
  std::optional<SourceImage> next() override;
  double rate() const override { return rate_; }

 private:
  DeviceOptions options_;
  const messaging::Clock& clock_;
  double rate_ = 0;
  cv::VideoCapture capture_;
};

}  // namespace fastball::camera
