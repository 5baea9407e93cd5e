#include "sim_bullet/camera_frame.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fastball::sim_bullet {
namespace {

constexpr int kFieldMargin = 509;             // [px], how far an image may be moved over the field
constexpr std::size_t kLargestImage = 60000;  // [bytes], image_t

/// What moves, as one camera sees it at the moments of an exposure.
struct Motion {
  std::array<std::vector<Limb>, kSubExposures> limbs;
  std::array<double, kSubExposures> ball_depth{};
  cv::Rect ball_area, figure_area;
  bool figure_still = true;  ///< moves less than a quarter of a pixel
};

double movement(const Limb& a, const Limb& b) {
  return std::max((a.start - b.start).norm(), (a.end - b.end).norm());
}

Motion motionOf(const Frame& frame) {
  const model::Camera& camera = frame.view->rig.camera;
  Motion motion;
  for (std::size_t i = 0; i < kSubExposures; ++i) {
    const SceneSnapshot& moment = frame.moments[i];
    motion.limbs[i] = frame.figure->limbs(camera, moment);
    motion.ball_depth[i] = camera.toCamera(moment.p_WBall).z();
    motion.ball_area |= ballBounds(camera, moment.p_WBall, frame.ball);
    for (const Limb& limb : motion.limbs[i])
      motion.figure_area |= boundsOf(limb);
  }
  motion.figure_area &= cv::Rect(0, 0, camera.width, camera.height);
  const std::vector<Limb>&first = motion.limbs.front(), &last = motion.limbs.back();
  motion.figure_still = first.size() == last.size();
  for (std::size_t k = 0; motion.figure_still && k < first.size(); ++k)
    motion.figure_still = movement(first[k], last[k]) < 0.25;
  return motion;
}

/// Draws one moment, the farthest first: limbs behind the ball, the ball, limbs and ring before it.
void drawMoment(const Frame& frame,
                const Motion& motion,
                std::size_t i,
                bool with_limbs,
                const cv::Point& origin,
                cv::Mat& layer) {
  const double depth = motion.ball_depth[i];
  if (with_limbs) {
    for (const Limb& limb : motion.limbs[i])
      if (limb.depth > depth)
        drawLimb(limb, origin, layer);
  }
  const cv::Rect area(origin, layer.size());
  if ((area & motion.ball_area).empty()) {
    if (with_limbs) {
      for (const Limb& limb : motion.limbs[i])
        if (limb.depth <= depth)
          drawLimb(limb, origin, layer);
    }
    return;
  }
  drawBall(*frame.view, frame.moments[i], frame.ball, origin, layer);
  for (const RingPiece& piece : frame.view->ring) {
    const Eigen::Vector2d middle = (piece.start + piece.end) / 2;
    const cv::Point p(static_cast<int>(middle.x()), static_cast<int>(middle.y()));
    if (piece.depth < depth && motion.ball_area.contains(p))
      drawRingPiece(piece, origin, layer);
  }
  if (with_limbs) {
    for (const Limb& limb : motion.limbs[i])
      if (limb.depth <= depth)
        drawLimb(limb, origin, layer);
  }
}

/// The mean of moments first, first + step, ... over a part of the image; CV_8U.
cv::Mat exposePart(const Frame& frame,
                   const Motion& motion,
                   const cv::Rect& area,
                   bool with_limbs,
                   int first,
                   int step) {
  cv::Mat sum = cv::Mat::zeros(area.size(), CV_16U);
  cv::Mat layer;
  int count = 0;
  for (int i = first; i < kSubExposures; i += step) {
    frame.view->background(area).copyTo(layer);
    drawMoment(frame, motion, static_cast<std::size_t>(i), with_limbs, area.tl(), layer);
    cv::add(sum, layer, sum, cv::noArray(), CV_16U);
    ++count;
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_16U, 16.0 / count);
  return mean;
}

/// image = (bright + noise) rounded; bright and noise in sixteenths of a grey level.
void expose(const cv::Mat& bright, const cv::Mat& noise, cv::Mat image) {
  const int cols = image.cols;
  for (int v = 0; v < image.rows; ++v) {
    const auto* from = bright.ptr<uint16_t>(v);
    const auto* add = noise.ptr<int16_t>(v);
    auto* to = image.ptr<uchar>(v);
    for (int u = 0; u < cols; ++u) {
      const int sum = (static_cast<int>(from[u]) + add[u] + 8) >> 4;
      to[u] = static_cast<uchar>(std::min(std::max(sum, 0), 255));
    }
  }
}

void exposeBackground(const cv::Mat& background, const cv::Mat& noise, cv::Mat& image) {
  const int cols = image.cols;
  for (int v = 0; v < image.rows; ++v) {
    const auto* from = background.ptr<uchar>(v);
    const auto* add = noise.ptr<int16_t>(v);
    auto* to = image.ptr<uchar>(v);
    // In 16 bit throughout, which the compiler turns into vector instructions; 255 * 16 and any noise fit.
    for (int u = 0; u < cols; ++u) {
      const auto bright = static_cast<int16_t>(from[u] << 4);
      auto sum = static_cast<int16_t>(bright + add[u]);
      sum = static_cast<int16_t>(sum + 8);
      sum = static_cast<int16_t>(sum >> 4);
      sum = sum < 0 ? int16_t{0} : sum;
      to[u] = static_cast<uchar>(sum > 255 ? int16_t{255} : sum);
    }
  }
}

/// A well mixed number from a seed and what it is for.
uint64_t mixed(int64_t seed, int camera, int64_t frame) {
  uint64_t h = static_cast<uint64_t>(seed);
  for (const uint64_t part :
       {static_cast<uint64_t>(camera) + 1, static_cast<uint64_t>(frame) + 1}) {
    h += 0x9E3779B97F4A7C15ULL * part;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    h ^= h >> 31;
  }
  return h;
}

}  // namespace

NoiseField::NoiseField(const cv::Size& size, double sigma)
    : size_(size), field_(size.height + kFieldMargin, size.width + kFieldMargin, CV_16S) {
  cv::RNG generator(0x5EED);
  generator.fill(field_, cv::RNG::NORMAL, 0.0, sigma * 16);
}

cv::Mat NoiseField::at(int64_t seed, int camera, int64_t frame) const {
  const uint64_t h = mixed(seed, camera, frame);
  const cv::Point place(static_cast<int>(h % kFieldMargin),
                        static_cast<int>((h >> 32) % kFieldMargin));
  return field_(cv::Rect(place, size_));
}

cv::Mat drawFrame(const Frame& frame) {
  const Motion motion = motionOf(frame);
  const cv::Mat noise = frame.noise->at(frame.seed, frame.image.camera, frame.image.frame);
  cv::Mat image(frame.view->background.size(), CV_8U);
  exposeBackground(frame.view->background, noise, image);
  const auto draw = [&](const cv::Rect& area, bool with_limbs, int first, int step) {
    if (!area.empty())
      expose(exposePart(frame, motion, area, with_limbs, first, step), noise(area), image(area));
  };
  if ((motion.ball_area & motion.figure_area).empty()) {
    draw(motion.figure_area, true, motion.figure_still ? kSubExposures / 2 : 0,
         motion.figure_still ? kSubExposures : 2);
    draw(motion.ball_area, false, 0, 1);
  } else {
    draw(motion.figure_area, true, motion.figure_still ? kSubExposures / 2 : 0,
         motion.figure_still ? kSubExposures : 2);
    draw(motion.ball_area, true, 0, 1);
  }
  return image;
}

RenderedImage renderFrame(const Frame& frame) {
  const cv::Mat picture = drawFrame(frame);
  RenderedImage image = frame.image;
  image.width = picture.cols;
  image.height = picture.rows;
  for (int quality = frame.jpeg_quality; quality > 0; quality -= 10) {
    cv::imencode(".jpg", picture, image.jpeg, {cv::IMWRITE_JPEG_QUALITY, quality});
    if (image.jpeg.size() <= kLargestImage)
      return image;
  }
  throw std::runtime_error("an image of " + std::to_string(image.jpeg.size()) +
                           " bytes does not fit a message of " + std::to_string(kLargestImage) +
                           " at any quality");
}

}  // namespace fastball::sim_bullet
