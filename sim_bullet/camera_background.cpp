#include "sim_bullet/camera_background.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fastball::sim_bullet {
namespace {

constexpr double kWallY = 3.0;    // [m], behind the experiment as the cameras see it
constexpr double kFloorZ = -1.2;  // [m]
constexpr double kPi = 3.14159265358979323846;
constexpr int kShift = 4;  // OpenCV's fixed point: 1/16 px

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
  constexpr double kTube = 0.008;  // [m]
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

void drawNet(const model::Camera& camera, const model::Target& target, cv::Mat& image) {
  constexpr int kStrings = 16;
  constexpr double kBag = 0.40;  // [m], how far the bag reaches behind the ring
  for (int i = 0; i < kStrings; ++i) {
    const double angle = 2 * kPi * i / kStrings, next = 2 * kPi * (i + 1) / kStrings;
    for (int ring = 0; ring < 3; ++ring) {
      const double near = ring / 3.0, far = (ring + 1) / 3.0;
      const Eigen::Vector3d a =
          ringPoint(target, angle, target.radius * (1 - 0.3 * near), kBag * near);
      const Eigen::Vector3d b =
          ringPoint(target, angle, target.radius * (1 - 0.3 * far), kBag * far);
      const Eigen::Vector3d c =
          ringPoint(target, next, target.radius * (1 - 0.3 * far), kBag * far);
      drawLine(camera, a, b, 85, 0.003, image);
      drawLine(camera, b, c, 85, 0.003, image);
    }
  }
  for (const RingPiece& piece : ringPieces(camera, target))
    drawRingPiece(piece, {0, 0}, image);
}

}  // namespace fastball::sim_bullet
