#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fastball::vision_tracker {

/// An image as it came.
struct ReceivedImage {
  int camera = 0;
  int64_t utime = 0;          ///< [us], middle of the exposure
  int64_t frame = 0;          ///< number that the camera gave it
  int width = 0, height = 0;  ///< [px]
  int row_stride = 0;         ///< [bytes]
  bool jpeg = true;           ///< else plain grey values
  std::vector<uint8_t> data;
};

/// Decodes an image to CV_8U of `size`.
/// @return why it cannot be used, or an empty text
std::string decode(const ReceivedImage& image, const cv::Size& size, cv::Mat& decoded);

/// Puts the images of several cameras in order of time, those of one time in order of camera, whichever way their streams
/// were woven together on the way. An image waits until every other camera has come as far.
class ImageOrder {
 public:
  /// @param cameras how many
  explicit ImageOrder(int cameras);
  void reset();
  enum class Verdict {
    kAccepted,
    kRepeated,   ///< its camera's newest image came again
    kSameTime,   ///< another image of the time of that one
    kBackwards,  ///< is older than that, or than the last image that was handed over
  };
  /// Takes an image in, if the verdict is kAccepted.
  Verdict push(ReceivedImage image);
  /// The next image, if it is known to be the next. A camera that is more than `kLongestQueue` images behind is not waited for.
  std::optional<ReceivedImage> next();
  /// The next image, whatever may still come.
  std::optional<ReceivedImage> nextAnyway();

  static constexpr std::size_t kLongestQueue = 48;  // 0.2 s at 240 Hz

 private:
  struct Stream {
    std::deque<ReceivedImage> queue;
    int64_t last = INT64_MIN;   ///< [us], of the newest image that came
    std::size_t last_hash = 0;  ///< of its bytes
  };
  std::size_t earliest() const;

  std::vector<Stream> streams_;
  int64_t handed_over_ = INT64_MIN;  ///< [us], of the last image that was handed over
};

}  // namespace fastball::vision_tracker
