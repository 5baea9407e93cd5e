#include "camera/video_file.h"

#include <fmt/format.h>

#include <stdexcept>

#include "camera/told_rate.h"

namespace fastball::camera {

VideoFile::VideoFile(std::string path, bool loop) : path_(std::move(path)), loop_(loop) {
  open();
  rate_ = toldRate(video_);
}

void VideoFile::open() {
  try {
    video_.open(path_);
  } catch (const cv::Exception&) {
    video_.release();
  }
  if (!video_.isOpened())
    throw std::invalid_argument(fmt::format("{}: cannot be read as a video", path_));
}

std::optional<SourceImage> VideoFile::next() {
  SourceImage image;
  if (video_.read(image.pixels) && !image.pixels.empty())
    return image;
  if (!loop_)
    return std::nullopt;
  // Not every format can be wound back.
  open();
  if (video_.read(image.pixels) && !image.pixels.empty())
    return image;
  throw std::invalid_argument(fmt::format("{}: holds no image", path_));
}

}  // namespace fastball::camera
