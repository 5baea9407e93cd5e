#include "camera/jpeg.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace fastball::camera {
namespace {

constexpr int kStep = 10;
constexpr int kLeastQuality = 10;  // below, a ball is but blocks

}  // namespace

std::vector<uint8_t> JpegEncoder::encode(const cv::Mat& pixels) {
  std::vector<uint8_t> bytes;
  while (true) {
    cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_QUALITY, quality_});
    if (bytes.size() <= limit_)
      return bytes;
    if (quality_ <= kLeastQuality)
      throw std::runtime_error(
          fmt::format("an image of {} x {} pixels has {} bytes at JPEG quality {}, but a message "
                      "carries {}: take a smaller --size or --gray",
                      pixels.cols, pixels.rows, bytes.size(), quality_, limit_));
    quality_ = std::max(kLeastQuality, quality_ - kStep);
  }
}

}  // namespace fastball::camera
