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

/// One stretch of a row. No branch, so that the compiler makes vector instructions of it.
void learnStretch(const uint8_t* image,
                  int16_t* mean,
                  int16_t* candidate,
                  int16_t* still,
                  int count,
                  int shift) {
  for (int i = 0; i < count; ++i) {
    const auto grey = static_cast<int16_t>(image[i]);
    const auto wide = static_cast<int16_t>(grey << 7);
    const auto difference = static_cast<int16_t>(wide - mean[i]);
    const bool same = difference <= kTolerance * Background::kScale &&
                      difference >= -kTolerance * Background::kScale;
    const auto change = static_cast<int16_t>(grey - candidate[i]);
    const bool stands = change <= kTolerance && change >= -kTolerance;
    const auto visits = static_cast<int16_t>(stands ? still[i] + 1 : 1);
    const bool adopt = !same && visits >= kStillVisits;
    const auto followed = static_cast<int16_t>(mean[i] + (difference >> shift));
    mean[i] = same ? followed : (adopt ? wide : mean[i]);
    candidate[i] = grey;
    still[i] = same || adopt ? int16_t{0} : visits;
  }
}

}  // namespace

void Background::reset() {
  images_ = 0;
}

void Background::learn(const cv::Mat& image, const cv::Rect& leave) {
  if (images_++ == 0) {
    image.convertTo(mean_, CV_16S, kScale);
    image.convertTo(candidate_, CV_16S);
    still_ = cv::Mat::zeros(image.size(), CV_16S);
    return;
  }
  const int shift = rateShift(images_ / 2);
  const cv::Rect hole = leave & cv::Rect(0, 0, image.cols, image.rows);
  for (int v = images_ % 2; v < image.rows; v += 2) {
    const auto* row = image.ptr<uint8_t>(v);
    auto* mean = mean_.ptr<int16_t>(v);
    auto* candidate = candidate_.ptr<int16_t>(v);
    auto* still = still_.ptr<int16_t>(v);
    const bool with_hole = v >= hole.y && v < hole.y + hole.height;
    const int end = with_hole ? hole.x : image.cols;
    learnStretch(row, mean, candidate, still, end, shift);
    if (with_hole) {
      const int start = hole.x + hole.width;
      learnStretch(row + start, mean + start, candidate + start, still + start, image.cols - start,
                   shift);
    }
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
