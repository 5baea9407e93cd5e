#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim_bullet/camera_background.h"
#include "sim_bullet/camera_ball.h"
#include "sim_bullet/camera_figure.h"

namespace fastball::sim_bullet {

/// The moving things are drawn this many times within an exposure, evenly spread, and averaged.
inline constexpr int kSubExposures = 5;

/// A finished image.
struct RenderedImage {
  int camera = 0;  ///< index into CameraRig::cameras()
  int64_t scene_id = 0;
  int64_t frame = 0;          ///< of this camera, 0 is the first of the scene
  int64_t utime = 0;          ///< [us], middle of the exposure
  int width = 0, height = 0;  ///< [px]
  std::vector<uint8_t> jpeg;
};

/// The noise of all images: one big field of 12.4 fixed-point normal numbers, read at a place drawn for each image.
class NoiseField {
 public:
  /// For images of `size`; `sigma` [grey levels].
  NoiseField(const cv::Size& size, double sigma);
  /// The part of the field for an image: CV_16S, in sixteenths of a grey level. The same for the same arguments.
  cv::Mat at(int64_t seed, int camera, int64_t frame) const;

 private:
  cv::Size size_;
  cv::Mat field_;
};

/// Everything that decides what an image looks like.
struct Frame {
  std::shared_ptr<const View> view;
  std::shared_ptr<const NoiseField> noise;
  std::shared_ptr<const Figure> figure;
  BallLook ball;
  std::array<SceneSnapshot, kSubExposures> moments;
  int64_t seed = 0;
  int jpeg_quality = 80;
  RenderedImage image;  ///< everything but the bytes
};

/// Draws the frame: CV_8U. A pure function.
cv::Mat drawFrame(const Frame& frame);

/// Draws and compresses, at a lower quality if it would not fit a message (60000 bytes). A pure
/// function. @throw std::runtime_error if it does not fit at any quality.
RenderedImage renderFrame(const Frame& frame);

}  // namespace fastball::sim_bullet
