#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace fastball::camera {

/// Compresses images as JPEG of at most `limit` bytes, at a quality that goes down by steps of ten where it must
/// and stays there, so that images look alike.
class JpegEncoder {
 public:
  /// @param quality 1 to 100 @param limit [bytes]
  JpegEncoder(int quality, std::size_t limit) : quality_(quality), limit_(limit) {}
  /// @param pixels CV_8UC1 or CV_8UC3
  /// @throw std::runtime_error if it does not fit even at quality 10
  std::vector<uint8_t> encode(const cv::Mat& pixels);
  /// 1 to 100, of the last image.
  int quality() const { return quality_; }

 private:
  int quality_;
  std::size_t limit_;
};

}  // namespace fastball::camera
