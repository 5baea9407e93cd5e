#pragma once

#include <opencv2/core.hpp>

namespace fastball::vision_tracker {

/// What stands still before one camera, learned while images come. A pixel that differs is foreground; one that has differed
/// but then stood still for a few images (what the arm has uncovered) becomes background. A ball in flight does not stand
/// still long enough. All whole-number arithmetic: the same images give the same background on every machine.
class Background {
 public:
  /// Fixed-point unit of mean(): 1 grey level is 128.
  static constexpr int kScale = 128;

  /// Learns from an image (CV_8U; every one of the same size); every other row in turn. Pixels in `leave` are not touched, nor
  /// those outside of `only`, unless it is empty.
  void learn(const cv::Mat& image, const cv::Rect& leave, const cv::Rect& only = {});
  /// How many images have been learned from.
  int images() const { return images_; }
  /// CV_16S, the still scene in 1/128 grey level; empty before the first image.
  const cv::Mat& mean() const { return mean_; }
  /// Standard deviation [grey levels] of the still scene's noise in `image` (CV_8U), robust against
  /// what moves, at least 0.7. Only after the first image.
  double noise(const cv::Mat& image) const;
  /// Forgets everything: the next image is the first.
  void reset();

 private:
  int images_ = 0;
  cv::Mat mean_;       ///< CV_16S
  cv::Mat candidate_;  ///< CV_16S [grey levels], what a foreground pixel was
  cv::Mat still_;      ///< CV_16S, how many visits it has stood still
};

}  // namespace fastball::vision_tracker
