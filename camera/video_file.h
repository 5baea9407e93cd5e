#pragma once

#include <opencv2/videoio.hpp>
#include <string>

#include "camera/image_source.h"

namespace fastball::camera {

/// The images of everything that OpenCV reads as a video; they know no time.
class VideoFile : public ImageSource {
 public:
  /// @param loop begins again at the end, for ever
  /// @throw std::invalid_argument if it is no video
  VideoFile(std::string path, bool loop);
  std::optional<SourceImage> next() override;
  double rate() const override { return rate_; }

 private:
  void open();

  std::string path_;
  bool loop_;
  double rate_ = 0;
  cv::VideoCapture video_;
};

}  // namespace fastball::camera
