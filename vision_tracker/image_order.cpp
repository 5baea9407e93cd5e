#include "vision_tracker/image_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

namespace fastball::vision_tracker {
namespace {

/// The size that a JPEG says it has, empty if it does not. A message of 60 kB can claim a gigabyte of pixels, which the decoder
/// would try; so this is looked at first (ITU-T T.81, Annex B: segments of a marker and a length up to the frame header).
cv::Size claimedSize(const std::vector<uint8_t>& jpeg) {
  const auto word = [&](std::size_t i) { return jpeg[i] << 8 | jpeg[i + 1]; };
  std::size_t i = 2;
  while (i + 9 < jpeg.size() && jpeg[i] == 0xFF) {
    const int marker = jpeg[i + 1];
    if (marker == 0xFF) {  // fill byte
      ++i;
      continue;
    }
    const bool other_table = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    if (marker >= 0xC0 && marker <= 0xCF && !other_table)
      return {word(i + 7), word(i + 5)};
    i += 2 + static_cast<std::size_t>(word(i + 2));
  }
  return {};
}

std::size_t hashOf(const std::vector<uint8_t>& bytes) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::string decode(const ReceivedImage& image, const cv::Size& size, cv::Mat& decoded) {
  if (image.width != size.width || image.height != size.height) {
    return fmt::format("is {} x {} pixels, but its camera has {} x {}", image.width, image.height,
                       size.width, size.height);
  }
  if (!image.jpeg) {
    if (image.row_stride < image.width ||
        image.data.size() !=
            static_cast<std::size_t>(image.row_stride) * static_cast<std::size_t>(image.height))
      return fmt::format("has {} bytes, but {} rows of {}", image.data.size(), image.height,
                         image.row_stride);
    const cv::Mat grey(size, CV_8U, const_cast<uint8_t*>(image.data.data()),
                       static_cast<std::size_t>(image.row_stride));
    grey.copyTo(decoded);
    return {};
  }
  // The decoder fills up a JPEG that was cut off, so look for its end mark first.
  const std::size_t n = image.data.size();
  if (n < 4 || image.data[0] != 0xFF || image.data[1] != 0xD8 || image.data[n - 2] != 0xFF ||
      image.data[n - 1] != 0xD9)
    return fmt::format("is no whole JPEG image ({} bytes)", n);
  const cv::Size claimed = claimedSize(image.data);
  if (!claimed.empty() && claimed != size)
    return fmt::format("decodes to {} x {} pixels, but its camera has {} x {}", claimed.width,
                       claimed.height, size.width, size.height);
  decoded.release();
  if (claimed.empty())
    return fmt::format("does not decode as JPEG ({} bytes)", n);
  try {
    cv::imdecode(image.data, cv::IMREAD_GRAYSCALE, &decoded);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty())
    return fmt::format("does not decode as JPEG ({} bytes)", n);
  if (decoded.size() != size || decoded.type() != CV_8U)
    return fmt::format("decodes to {} x {} pixels, but its camera has {} x {}", decoded.cols,
                       decoded.rows, size.width, size.height);
  return {};
}

ImageOrder::ImageOrder(int cameras) : streams_(static_cast<std::size_t>(cameras)) {}

void ImageOrder::reset() {
  streams_.assign(streams_.size(), {});
  handed_over_ = INT64_MIN;
}

ImageOrder::Verdict ImageOrder::push(ReceivedImage image) {
  Stream& stream = streams_[static_cast<std::size_t>(image.camera)];
  const std::size_t hash = hashOf(image.data);
  if (image.utime == stream.last)
    return hash == stream.last_hash ? Verdict::kRepeated : Verdict::kSameTime;
  if (image.utime < stream.last || image.utime < handed_over_)
    return Verdict::kBackwards;
  stream.last = image.utime;
  stream.last_hash = hash;
  stream.queue.push_back(std::move(image));
  return Verdict::kAccepted;
}

std::size_t ImageOrder::earliest() const {
  std::size_t best = streams_.size();
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    if (!streams_[i].queue.empty() &&
        (best == streams_.size() ||
         streams_[i].queue.front().utime < streams_[best].queue.front().utime))
      best = i;
  }
  return best;
}

std::optional<ReceivedImage> ImageOrder::next() {
  const std::size_t best = earliest();
  if (best == streams_.size())
    return std::nullopt;
  const int64_t utime = streams_[best].queue.front().utime;
  const bool overdue = streams_[best].queue.size() > kLongestQueue;
  const bool known = std::all_of(streams_.begin(), streams_.end(),
                                 [&](const Stream& s) { return s.last >= utime; });
  return known || overdue ? nextAnyway() : std::nullopt;
}

std::optional<ReceivedImage> ImageOrder::nextAnyway() {
  const std::size_t best = earliest();
  if (best == streams_.size())
    return std::nullopt;
  ReceivedImage image = std::move(streams_[best].queue.front());
  streams_[best].queue.pop_front();
  handed_over_ = image.utime;
  return image;
}

}  // namespace fastball::vision_tracker
