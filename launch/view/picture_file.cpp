#include "launch/view/picture_file.h"

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace fastball::view {

std::optional<PageFiles::File> pictureFile(const image_t& image) {
  if (image.pixelformat == image_t::MJPEG)
    return PageFiles::File{"image/jpeg", std::string(image.data.begin(), image.data.end())};
  const bool fits = image.width > 0 && image.height > 0 && image.row_stride >= image.width &&
                    image.data.size() >= static_cast<std::size_t>(image.row_stride) *
                                             static_cast<std::size_t>(image.height);
  if (image.pixelformat != image_t::GRAY || !fits)
    return std::nullopt;
  // OpenCV has no view of memory that must not be written.
  std::vector<uint8_t> grey(image.data.begin(), image.data.end());
  const cv::Mat rows(image.height, image.width, CV_8UC1, grey.data(),
                     static_cast<std::size_t>(image.row_stride));
  std::vector<uint8_t> png;
  if (!cv::imencode(".png", rows, png))
    return std::nullopt;
  return PageFiles::File{"image/png", std::string(png.begin(), png.end())};
}

}  // namespace fastball::view
