#include "bench/ball_images.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "vision_tracker/sphere_outline.h"

namespace fastball::bench {
namespace {

constexpr int kSize = 128;                           // [px], of the image
constexpr int kRays = 5;                             // per pixel and axis
constexpr int kMoments = 5;                          // of an exposure
constexpr int kImagesToLearn = 24;                   // of the empty scene
constexpr double kFocalLength = 900;                 // [px]
constexpr double kBallRadius = 0.05;                 // [m]
constexpr double kPixelSigma = 0.28867513459481287;  // [px], of a square pixel

class BallScene {
 public:
  BallScene(const BallImageOptions& options, int seed)
      : options_(options), random_(static_cast<unsigned>(seed)) {
    camera_.width = camera_.height = kSize;
    camera_.fx = camera_.fy = kFocalLength;
    camera_.cx = camera_.cy = (kSize - 1) / 2.0;
    const double depth = kFocalLength * kBallRadius / options.radius;
    const double u = uniform(50, 78), v = uniform(50, 78);
    p_W_ = depth *
           Eigen::Vector3d((u - camera_.cx) / kFocalLength, (v - camera_.cy) / kFocalLength, 1);
    const double side = uniform(0, 2 * CV_PI), way = uniform(0, 2 * CV_PI);
    light_ = Eigen::Vector2d(std::cos(side), std::sin(side));
    // From the side, and a little from behind the camera.
    to_light_ = Eigen::Vector3d(0.85 * light_.x(), 0.85 * light_.y(), -0.53).normalized();
    moved_W_ =
        depth / kFocalLength * options.motion * Eigen::Vector3d(std::cos(way), std::sin(way), 0);
    clutter_ = drawClutter();
    empty_ = throughLens(clutter_);
  }

  const model::Camera& camera() const { return camera_; }
  const Eigen::Vector3d& p_W() const { return p_W_; }
  /// [m], during the exposure.
  const Eigen::Vector3d& moved_W() const { return moved_W_; }
  const Eigen::Vector2d& light() const { return light_; }

  cv::Mat empty() { return exposed(empty_); }
  cv::Mat withBall() {
    cv::Mat1f bright = cv::Mat1f::zeros(kSize * kRays, kSize * kRays);
    for (int i = 0; i < kMoments; ++i) {
      cv::Mat1f moment = clutter_.clone();
      drawBall(p_W_ + ((i + 0.5) / kMoments - 0.5) * moved_W_, moment);
      bright += moment / kMoments;
    }
    return exposed(throughLens(bright));
  }

 private:
  cv::Mat1f throughLens(const cv::Mat1f& bright) const {
    const double lens =
        std::sqrt(options_.blur * options_.blur - kPixelSigma * kPixelSigma) * kRays;
    cv::Mat1f blurred, grey;
    cv::GaussianBlur(bright, blurred, {0, 0}, lens, lens, cv::BORDER_REPLICATE);
    cv::resize(blurred, grey, {kSize, kSize}, 0, 0, cv::INTER_AREA);
    return grey;
  }

  cv::Mat exposed(const cv::Mat1f& bright) {
    cv::Mat1f grey = bright.clone();
    std::normal_distribution<float> normal(0, static_cast<float>(options_.noise));
    for (float& value : grey)
      value += normal(random_);
    cv::Mat picture;
    grey.convertTo(picture, CV_8U);
    std::vector<uint8_t> jpeg;
    cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, options_.jpeg_quality});
    return cv::imdecode(jpeg, cv::IMREAD_GRAYSCALE);
  }

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

  cv::Mat1f drawClutter() {
    const double lightest = kDark - options_.contrast;
    cv::Mat1f clutter(kSize * kRays, kSize * kRays, static_cast<float>(lightest - 20));
    for (int i = 0; i < 12; ++i) {
      const cv::Point a(static_cast<int>(uniform(0, kSize * kRays)),
                        static_cast<int>(uniform(0, kSize * kRays)));
      const cv::Size size(static_cast<int>(uniform(30, 250)), static_cast<int>(uniform(30, 250)));
      clutter(cv::Rect(a, size) & cv::Rect({0, 0}, clutter.size()))
          .setTo(uniform(lightest - 50, lightest));
    }
    return clutter;
  }

  void drawBall(const Eigen::Vector3d& c, cv::Mat1f& image) const {
    const double beyond = c.squaredNorm() - kBallRadius * kBallRadius;
    const int middle_x = static_cast<int>(((c.x() / c.z()) * kFocalLength + camera_.cx) * kRays);
    const int middle_y = static_cast<int>(((c.y() / c.z()) * kFocalLength + camera_.cy) * kRays);
    const int reach = static_cast<int>((1.1 * options_.radius + 2) * kRays);
    for (int y = middle_y - reach; y < middle_y + reach; ++y) {
      for (int x = middle_x - reach; x < middle_x + reach; ++x) {
        const Eigen::Vector3d ray(((x + 0.5) / kRays - 0.5 - camera_.cx) / kFocalLength,
                                  ((y + 0.5) / kRays - 0.5 - camera_.cy) / kFocalLength, 1);
        const double a = ray.squaredNorm(), b = ray.dot(c), root = b * b - a * beyond;
        if (root < 0)
          continue;
        const Eigen::Vector3d normal = ((b - std::sqrt(root)) / a * ray - c) / kBallRadius;
        image(y, x) =
            static_cast<float>(kDark + options_.lamp * std::max(0.0, normal.dot(to_light_)));
      }
    }
  }

  static constexpr double kDark = 110;  // [grey levels], of the ball's dark side

  BallImageOptions options_;
  std::mt19937 random_;
  model::Camera camera_;
  Eigen::Vector3d p_W_, to_light_, moved_W_;
  Eigen::Vector2d light_;
  cv::Mat1f clutter_;  ///< kRays a pixel
  cv::Mat1f empty_;
};

}  // namespace

BallImageTrial ballImageTrial(const BallImageOptions& options, int seed) {
  BallScene scene(options, seed);
  vision_tracker::DetectorOptions detector;
  detector.ball_radius = kBallRadius;
  const double depth = scene.p_W().z();
  detector.nearest = 0.6 * depth;
  detector.farthest = 1.6 * depth;
  detector.blur = options.blur;
  vision_tracker::Background background;
  for (int i = 0; i < kImagesToLearn; ++i)
    background.learn(scene.empty(), {});
  constexpr double kExposure = 1e-3;
  const vision_tracker::BallDetector finder(scene.camera(), kExposure, detector);
  // Expected a pixel off, as a young track does.
  const Eigen::Vector3d expected =
      scene.p_W() + depth / kFocalLength * Eigen::Vector3d(0.8, -0.6, 0);
  const vision_tracker::BallFit fit =
      finder.at(scene.withBall(), background, expected, scene.moved_W() / kExposure, 8);
  BallImageTrial trial;
  trial.found = fit.converged;
  trial.light = scene.light();
  trial.cov = fit.cov;
  trial.error =
      fit.centre - vision_tracker::outlineCentre(scene.camera(), scene.p_W(), kBallRadius);
  return trial;
}

}  // namespace fastball::bench
