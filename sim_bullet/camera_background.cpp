#include "sim_bullet/camera_background.h"

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace fastball::sim_bullet {
namespace {

constexpr double kWallY = 3.0;    // [m], behind the experiment as the cameras see it
constexpr double kFloorZ = -1.2;  // [m]
constexpr double kPi = 3.14159265358979323846;
constexpr int kShift = 4;        // OpenCV's fixed point: 1/16 px
constexpr double kTube = 0.008;  // [m], diameter of the ring's tube

/// A value in [0, 1) for a whole-numbered place, the same everywhere (integer hash).
double hashed(int64_t x, int64_t y) {
  uint64_t h = static_cast<uint64_t>(x) * 0x9E3779B97F4A7C15ULL +
               static_cast<uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

/// Smooth noise in [0, 1), cells of size 1.
double smoothNoise(double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<int64_t>(fx), iy = static_cast<int64_t>(fy);
  const double u = x - fx, v = y - fy;
  const double a = u * u * (3 - 2 * u), b = v * v * (3 - 2 * v);
  return (1 - b) * ((1 - a) * hashed(ix, iy) + a * hashed(ix + 1, iy)) +
         b * ((1 - a) * hashed(ix, iy + 1) + a * hashed(ix + 1, iy + 1));
}

/// Grey level of the wall at (x, z) [m]: panels of different grey, joints between them, plaster.
double wallGrey(double x, double z) {
  const double panel_x = std::floor(x / 1.3), panel_z = std::floor(z / 0.9);
  double grey = 38 + 26 * hashed(static_cast<int64_t>(panel_x), static_cast<int64_t>(panel_z));
  grey += 14 * (smoothNoise(x * 4, z * 4) - 0.5) + 8 * (smoothNoise(x * 19, z * 19) - 0.5);
  const double joint = std::min({x / 1.3 - panel_x, 1 - (x / 1.3 - panel_x)}) * 1.3;
  return joint < 0.012 ? grey - 16 : grey;
}

double floorGrey(double x, double y) {
  const bool dark =
      (static_cast<int64_t>(std::floor(x / 0.6)) + static_cast<int64_t>(std::floor(y / 0.6))) % 2 !=
      0;
  return (dark ? 46 : 62) + 12 * (smoothNoise(x * 7, y * 7) - 0.5);
}

cv::Point fixedPoint(const Eigen::Vector2d& p, const cv::Point& origin = {0, 0}) {
  return {static_cast<int>(std::lround((p.x() - origin.x) * (1 << kShift))),
          static_cast<int>(std::lround((p.y() - origin.y) * (1 << kShift)))};
}

Eigen::Vector3d ringPoint(const model::Target& target, double angle, double radius, double behind) {
  return target.p_WTarget +
         radius * (std::cos(angle) * target.rightAxis() + std::sin(angle) * target.upAxis()) -
         behind * target.n_WTarget;
}

void drawLine(const model::Camera& camera,
              const Eigen::Vector3d& a,
              const Eigen::Vector3d& b,
              int grey,
              double width,
              cv::Mat& image) {
  const double depth = std::min(camera.toCamera(a).z(), camera.toCamera(b).z());
  if (depth < 0.1)
    return;
  const int thickness = std::max(1, static_cast<int>(std::lround(camera.fx * width / depth)));
  cv::line(image, fixedPoint(camera.project(a)), fixedPoint(camera.project(b)), cv::Scalar(grey),
           thickness, cv::LINE_AA, kShift);
}

/// Lines of one grey level, drawn eight times finer than the image.
class Layer {
 public:
  Layer(const cv::Size& size, double blur) : size_(size), blur_(blur) {}

  void add(const model::Camera& camera,
           const Eigen::Vector3d& a,
           const Eigen::Vector3d& b,
           double width) {
    const double depth = std::min(camera.toCamera(a).z(), camera.toCamera(b).z());
    if (depth < 0.1)
      return;
    lines_.push_back({camera.project(a), camera.project(b), camera.fx * width / depth});
    for (const Eigen::Vector2d& p : {lines_.back().start, lines_.back().end})
      if (p.cwiseAbs().maxCoeff() < 1e5)
        area_ |= cv::Rect(static_cast<int>(p.x()) - kBorder, static_cast<int>(p.y()) - kBorder,
                          2 * kBorder, 2 * kBorder);
  }

  void paint(int grey, cv::Mat& image) const {
    const cv::Rect area = area_ & cv::Rect({0, 0}, size_);
    if (area.empty())
      return;
    cv::Mat fine = cv::Mat::zeros(area.size() * kFiner, CV_8U);
    for (const Line& line : lines_)
      cv::line(fine, place(line.start, area), place(line.end, area), cv::Scalar(255),
               std::max(1, static_cast<int>(std::lround(line.width * kFiner))), cv::LINE_AA,
               kShift);
    cv::Mat share;
    cv::resize(fine, share, area.size(), 0, 0, cv::INTER_AREA);
    share.convertTo(share, CV_32F, 1.0 / 255);
    cv::GaussianBlur(share, share, {}, blur_, blur_);
    for (int v = 0; v < area.height; ++v) {
      for (int u = 0; u < area.width; ++u) {
        uchar& pixel = image.at<uchar>(area.y + v, area.x + u);
        pixel = cv::saturate_cast<uchar>(static_cast<float>(pixel) +
                                         share.at<float>(v, u) * static_cast<float>(grey - pixel));
      }
    }
  }

 private:
  static constexpr int kFiner = 8;
  static constexpr int kBorder = 8;  // [px], for width and blur
  struct Line {
    Eigen::Vector2d start, end;  ///< [px]
    double width = 0;            ///< [px]
  };

  /// In the fine image's fixed point; its pixels' centres lie at whole numbers too.
  static cv::Point place(const Eigen::Vector2d& p, const cv::Rect& area) {
    return fixedPoint((p - Eigen::Vector2d(area.x, area.y)) * kFiner +
                      Eigen::Vector2d::Constant((kFiner - 1) / 2.0));
  }

  cv::Size size_;
  double blur_;
  std::vector<Line> lines_;
  cv::Rect area_;
};

}  // namespace

cv::Mat rayMap(const model::Camera& camera) {
  cv::Mat rays(camera.height, camera.width, CV_32FC2);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d ray = camera.undistort({u, v});
      rays.at<cv::Vec2f>(v, u) = {static_cast<float>(ray.x()), static_cast<float>(ray.y())};
    }
  }
  return rays;
}

cv::Mat drawRoom(const model::Camera& camera, const cv::Mat& rays) {
  cv::Mat image(rays.size(), CV_8U);
  const Eigen::Vector3d p_WCamera = -camera.R_CW.transpose() * camera.p_CW;
  for (int v = 0; v < rays.rows; ++v) {
    for (int u = 0; u < rays.cols; ++u) {
      const auto& ray = rays.at<cv::Vec2f>(v, u);
      const Eigen::Vector3d d = camera.R_CW.transpose() * Eigen::Vector3d(ray[0], ray[1], 1);
      const double to_wall = d.y() > 1e-6 ? (kWallY - p_WCamera.y()) / d.y() : 1e6;
      const double to_floor = d.z() < -1e-6 ? (kFloorZ - p_WCamera.z()) / d.z() : 1e6;
      const Eigen::Vector3d p = p_WCamera + std::min(to_wall, to_floor) * d;
      const double grey = to_wall < to_floor ? wallGrey(p.x(), p.z()) : floorGrey(p.x(), p.y());
      image.at<uchar>(v, u) = cv::saturate_cast<uchar>(grey);
    }
  }
  // The column that carries the shoulder.
  drawLine(camera, {0, 0, kFloorZ}, {0, 0, -0.15}, 95, 0.22, image);
  drawLine(camera, {-0.02, -0.05, kFloorZ}, {-0.02, -0.05, -0.15}, 110, 0.07, image);
  return image;
}

std::vector<RingPiece> ringPieces(const model::Camera& camera, const model::Target& target) {
  constexpr int kPieces = 32;
  std::vector<RingPiece> pieces;
  for (int i = 0; i < kPieces; ++i) {
    const Eigen::Vector3d a =
        ringPoint(target, 2 * kPi * i / kPieces, target.radius + kTube / 2, 0);
    const Eigen::Vector3d b =
        ringPoint(target, 2 * kPi * (i + 1) / kPieces, target.radius + kTube / 2, 0);
    const double depth = camera.toCamera((a + b) / 2).z();
    if (depth < 0.1)
      continue;
    pieces.push_back({camera.project(a), camera.project(b), depth, camera.fx * kTube / depth});
  }
  return pieces;
}

void drawRingPiece(const RingPiece& piece, const cv::Point& origin, cv::Mat& image) {
  cv::line(image, fixedPoint(piece.start, origin), fixedPoint(piece.end, origin), cv::Scalar(150),
           std::max(1, static_cast<int>(std::lround(piece.width))), cv::LINE_AA, kShift);
}

void drawNet(const model::Camera& camera,
             const model::Target& target,
             double blur,
             cv::Mat& image) {
  constexpr int kStrings = 16;
  constexpr int kPieces = 128;
  constexpr double kBag = 0.40;  // [m], how far the bag reaches behind the ring
  Layer strings(image.size(), blur), ring(image.size(), blur);
  for (int i = 0; i < kStrings; ++i) {
    const double angle = 2 * kPi * i / kStrings, next = 2 * kPi * (i + 1) / kStrings;
    for (int row = 0; row < 3; ++row) {
      const double near = row / 3.0, far = (row + 1) / 3.0;
      const Eigen::Vector3d a =
          ringPoint(target, angle, target.radius * (1 - 0.3 * near), kBag * near);
      const Eigen::Vector3d b =
          ringPoint(target, angle, target.radius * (1 - 0.3 * far), kBag * far);
      const Eigen::Vector3d c =
          ringPoint(target, next, target.radius * (1 - 0.3 * far), kBag * far);
      strings.add(camera, a, b, 0.003);
      strings.add(camera, b, c, 0.003);
    }
  }
  for (int i = 0; i < kPieces; ++i)
    ring.add(camera, ringPoint(target, 2 * kPi * i / kPieces, target.radius + kTube / 2, 0),
             ringPoint(target, 2 * kPi * (i + 1) / kPieces, target.radius + kTube / 2, 0), kTube);
  strings.paint(85, image);
  ring.paint(150, image);
}

}  // namespace fastball::sim_bullet
