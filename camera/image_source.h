#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

namespace fastball::camera {

/// An image as a source gives it.
struct SourceImage {
  cv::Mat pixels;  ///< CV_8UC1 (grey) or CV_8UC3 (blue, green, red)
  std::optional<int64_t>
      utime;          ///< [us since 1970], middle of the exposure, if the source knows it
  int64_t frame = 0;  ///< from 0, as Capture counts them: those that it dropped included
};

/// Where a camera's images come from. Used by one thread, the one that opened it.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  /// The next image; may block for as long as the device likes. @return nothing after the last one
  /// @throw std::runtime_error if the device has failed, std::invalid_argument if the file is none
  virtual std::optional<SourceImage> next() = 0;
  /// [Hz] as the source tells it, 0 if it does not.
  virtual double rate() const = 0;
};

/// Opens a source, on the thread that will read it. @throw as ImageSource::next()
using OpenSource = std::function<std::unique_ptr<ImageSource>()>;

}  // namespace fastball::camera
