#include "vision_tracker/background.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fastball::vision_tracker {
namespace {

constexpr int16_t kTolerance = 8;    // [grey levels], four times a usual noise
constexpr int16_t kStillVisits = 4;  // visits, that is eight images: 33 ms at 240 Hz

/// Learning rate 2^-shift of the n-th visit: the plain mean at first, then the last sixteen visits or so.
int rateShift(int visit) {
  int shift = 1;
  while ((1 << shift) < visit + 1 && shift < 4)
    ++shift;
  return shift;
}

/// One of two values by a mask of no bits or all.
inline int16_t chosen(int16_t mask, int16_t yes, int16_t no) {
  return static_cast<int16_t>((mask & yes) | (~mask & no));
}

/// No bits, or all if x lies within +-limit.
inline int16_t within(int16_t x, int16_t limit) {
  return static_cast<int16_t>(-((x <= limit) & (x >= -limit)));
}

/// One stretch of a row. Masks instead of branches, and no two pointers to one place, so that the compiler makes vector
/// instructions of it.
void learnStretch(const uint8_t* __restrict image,
                  int16_t* __restrict mean,
                  int16_t* __restrict candidate,
                  int16_t* __restrict still,
                  int count,
                  int shift) {
  for (int i = 0; i < count; ++i) {
    const auto grey = static_cast<int16_t>(image[i]);
    const auto wide = static_cast<int16_t>(grey << 7);
    const auto difference = static_cast<int16_t>(wide - mean[i]);
    const int16_t same = within(difference, kTolerance * Background::kScale);
    const int16_t stands = within(static_cast<int16_t>(grey - candidate[i]), kTolerance);
    const auto visits = static_cast<int16_t>((still[i] & stands) + 1);
    const auto adopt = static_cast<int16_t>(~same & -(visits >= kStillVisits));
    const auto followed = static_cast<int16_t>(mean[i] + (difference >> shift));
    mean[i] = chosen(same, followed, chosen(adopt, wide, mean[i]));
    candidate[i] = grey;
    still[i] = static_cast<int16_t>(~(same | adopt) & visits);
  }
}

}  // namespace

void Background::reset() {
  images_ = 0;
}

void Background::learn(const cv::Mat& image, const cv::Rect& leave, const cv::Rect& only) {
  if (images_++ == 0) {
    image.convertTo(mean_, CV_16S, kScale);
    image.convertTo(candidate_, CV_16S);
    still_ = cv::Mat::zeros(image.size(), CV_16S);
    return;
  }
  const int shift = rateShift(images_ / 2);
  const cv::Rect all(0, 0, image.cols, image.rows);
  const cv::Rect part = only.empty() ? all : only & all;
  const cv::Rect hole = leave & part;
  for (int v = part.y + (images_ + part.y) % 2; v < part.y + part.height; v += 2) {
    const auto stretch = [&](int from, int to) {
      learnStretch(image.ptr<uint8_t>(v) + from, mean_.ptr<int16_t>(v) + from,
                   candidate_.ptr<int16_t>(v) + from, still_.ptr<int16_t>(v) + from, to - from,
                   shift);
    };
    const bool with_hole = v >= hole.y && v < hole.y + hole.height;
    stretch(part.x, with_hole ? hole.x : part.x + part.width);
    if (with_hole)
      stretch(hole.x + hole.width, part.x + part.width);
  }
}

double Background::noise(const cv::Mat& image) const {
  constexpr int kStride = 17;      // prime, so that it does not fall in step with JPEG's blocks
  constexpr double kLowest = 0.7;  // [grey levels], rounding alone makes 0.3
  std::array<int, 256> histogram{};
  int count = 0;
  for (int v = 5; v < image.rows; v += kStride) {
    for (int u = 3; u < image.cols; u += kStride) {
      const int difference = std::abs(image.at<uint8_t>(v, u) * kScale - mean_.at<int16_t>(v, u));
      // Bins of 1/8 grey level.
      ++histogram[static_cast<std::size_t>(std::min(255, difference / 16))];
      ++count;
    }
  }
  int below = 0;
  std::size_t bin = 0;
  while (bin < 255 && 2 * (below += histogram[bin]) < count)
    ++bin;
  // The median of |x| of a normal x is 0.6745 standard deviations.
  return std::max(kLowest, (static_cast<double>(bin) + 0.5) / 8 / 0.6745);
}

}  // namespace fastball::vision_tracker
