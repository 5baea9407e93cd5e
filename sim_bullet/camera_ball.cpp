#include "sim_bullet/camera_ball.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fastball::sim_bullet {
namespace {

constexpr double kAmbient = 95;  // [grey levels], the side away from the lamp
constexpr double kLamp = 125;    // [grey levels], added where the lamp shines straight on
constexpr double kMottle = 4;    // [grey levels], the foam is not even: spots of about 1 cm

/// Grey level of the surface with outward unit normal n_W.
double shade(const Eigen::Vector3d& n_W, const SceneSnapshot& snapshot, const BallLook& look) {
  const Eigen::Vector3d n_B = snapshot.R_WBall.transpose() * n_W;
  const double mottle = std::sin(17 * n_B.x() + 5 * n_B.y()) *
                        std::sin(15 * n_B.y() - 6 * n_B.z()) * std::sin(18 * n_B.z() + 4 * n_B.x());
  return kAmbient + kLamp * std::max(0.0, n_W.dot(look.to_light_W)) + kMottle * mottle;
}

/// Share of a pixel covered when the outline passes at `distance` [px] outside of its centre.
double coverage(double distance, double blur) {
  if (distance > 4 * blur)
    return 1;
  if (distance < -4 * blur)
    return 0;
  return 0.5 * std::erfc(-distance / (blur * std::sqrt(2.0)));
}

/// The part of an image that a ball may touch, and its rays.
struct Patch {
  cv::Rect area;
  Eigen::Vector3d c_C;  ///< [m], ball centre in the camera frame
  double limb = 0;      ///< tangent of the half angle of the cone around the ball

  Patch(const View& view, const SceneSnapshot& snapshot, const BallLook& look)
      : area(ballBounds(view.rig.camera, snapshot.p_WBall, look)),
        c_C(view.rig.camera.toCamera(snapshot.p_WBall)),
        limb(look.radius /
             std::sqrt(std::max(1e-12, c_C.squaredNorm() - look.radius * look.radius))) {}

  /// 1 on the axis of the cone, 0 on the outline, negative outside.
  double inside(const Eigen::Vector3d& d) const {
    return 1 - d.cross(c_C).norm() / (d.dot(c_C) * limb);
  }

  /// Outward normal in the camera frame where the ray meets the ball, or of the outline's nearest point.
  Eigen::Vector3d normal(const Eigen::Vector3d& d, double radius) const {
    const double along = d.dot(c_C) / d.squaredNorm();
    const double under_root =
        along * along - (c_C.squaredNorm() - radius * radius) / d.squaredNorm();
    return ((along - std::sqrt(std::max(0.0, under_root))) * d - c_C).normalized();
  }
};

}  // namespace

cv::Rect ballBounds(const model::Camera& camera,
                    const Eigen::Vector3d& p_WBall,
                    const BallLook& look) {
  const Eigen::Vector3d c = camera.toCamera(p_WBall);
  if (c.z() < 3 * look.radius || c.head<2>().norm() > 1.2 * c.z())
    return {};
  const Eigen::Vector2d centre = camera.distort(c.head<2>() / c.z());
  // The outline's long half axis is r / cos(angle off the axis), for angles as small as these.
  const double reach =
      camera.fx * look.radius / c.z() * std::sqrt(1 + (c.head<2>() / c.z()).squaredNorm()) * 1.1 +
      4 * look.blur + 2;
  const cv::Point low(static_cast<int>(std::floor(centre.x() - reach)),
                      static_cast<int>(std::floor(centre.y() - reach)));
  const cv::Point high(static_cast<int>(std::ceil(centre.x() + reach)) + 1,
                       static_cast<int>(std::ceil(centre.y() + reach)) + 1);
  return cv::Rect(low, high) & cv::Rect(0, 0, camera.width, camera.height);
}

void drawBall(const View& view,
              const SceneSnapshot& snapshot,
              const BallLook& look,
              const cv::Point& origin,
              cv::Mat& image) {
  const Patch patch(view, snapshot, look);
  const cv::Rect area = patch.area & cv::Rect(origin, image.size());
  if (area.width < 3 || area.height < 3)
    return;
  const auto ray = [&](int u, int v) {
    const auto& r = view.rays.at<cv::Vec2f>(v, u);
    return Eigen::Vector3d(r[0], r[1], 1);
  };
  cv::Mat1d inside(area.size());
  for (int v = 0; v < area.height; ++v)
    for (int u = 0; u < area.width; ++u)
      inside(v, u) = patch.inside(ray(area.x + u, area.y + v));
  for (int v = 0; v < area.height; ++v) {
    for (int u = 0; u < area.width; ++u) {
      const int left = std::max(u - 1, 0), right = std::min(u + 1, area.width - 1);
      const int up = std::max(v - 1, 0), down = std::min(v + 1, area.height - 1);
      const double slope = std::hypot((inside(v, right) - inside(v, left)) / (right - left),
                                      (inside(down, u) - inside(up, u)) / (down - up));
      const double share = coverage(inside(v, u) / std::max(slope, 1e-3), look.blur);
      if (share <= 0)
        continue;
      const Eigen::Vector3d n_C = patch.normal(ray(area.x + u, area.y + v), look.radius);
      const double grey = shade(view.rig.camera.R_CW.transpose() * n_C, snapshot, look);
      uchar& pixel = image.at<uchar>(area.y + v - origin.y, area.x + u - origin.x);
      pixel = cv::saturate_cast<uchar>(pixel + share * (grey - pixel));
    }
  }
}

}  // namespace fastball::sim_bullet
