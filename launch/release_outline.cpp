#include "launch/release_outline.h"

#include <fmt/format.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/geometries.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <cmath>

namespace fastball::launch {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kHalfTurn = 16;  ///< corners of half a circle

/// Half a circle about `centre`, anticlockwise from the direction `first` [rad].
void addHalfCircle(const Vector2d& centre, double radius, double first, Outline& outline) {
  for (int i = 0; i <= kHalfTurn; ++i) {
    const double angle = first + M_PI * i / kHalfTurn;
    outline.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
}

}  // namespace

ThrowPlane::ThrowPlane(const Vector3d& v_WBall, const Eigen::Isometry3d& X_WH) {
  const Vector3d level(v_WBall.x(), v_WBall.y(), 0), towards_elbow = -X_WH.linear().col(2);
  // A ball thrown straight up, or along the forearm, lies in many planes: any of them will do.
  right_ = level.norm() > 1e-6 ? Vector3d(level.normalized()) : Vector3d(Vector3d::UnitX());
  const Vector3d across = towards_elbow - towards_elbow.dot(right_) * right_;
  up_ = across.norm() > 1e-6 ? Vector3d(across.normalized()) : Vector3d(right_.unitOrthogonal());
}

Vector2d ThrowPlane::at(const Vector3d& p_W) const {
  return {right_.dot(p_W), up_.dot(p_W)};
}

double ThrowPlane::behind(const Vector3d& p_W) const {
  return up_.cross(right_).dot(p_W);
}

Outline circleOutline(const Vector2d& centre, double radius) {
  return capsuleOutline(centre, centre, radius);
}

Outline capsuleOutline(const Vector2d& start, const Vector2d& end, double radius) {
  const double direction = std::atan2(end.y() - start.y(), end.x() - start.x());
  Outline outline;
  addHalfCircle(end, radius, direction - M_PI / 2, outline);
  addHalfCircle(start, radius, direction + M_PI / 2, outline);
  outline.push_back(outline.front());
  return outline;
}

Outline palmOutline(const ThrowPlane& plane,
                    const Eigen::Isometry3d& X_WH,
                    const model::HandParameters& hand) {
  using Point = boost::geometry::model::d2::point_xy<double>;
  boost::geometry::model::multi_point<Point> rims;
  for (const double distance : {0.0, hand.palm_distance}) {
    for (int i = 0; i < 2 * kHalfTurn; ++i) {
      const double angle = M_PI * i / kHalfTurn;
      const Vector2d p = plane.at(X_WH * Vector3d(hand.palm_radius * std::cos(angle),
                                                  hand.palm_radius * std::sin(angle), distance));
      rims.push_back({p.x(), p.y()});
    }
  }
  boost::geometry::model::ring<Point> hull;
  boost::geometry::convex_hull(rims, hull);
  Outline outline;
  for (const Point& p : hull)
    outline.emplace_back(p.x(), p.y());
  return outline;
}

std::string polygon(const Outline& outline, const Vector2d& origin) {
  std::string data;
  for (const Vector2d& p : outline)
    data += fmt::format("{:.5f} {:.5f}\n", p.x() - origin.x(), p.y() - origin.y());
  return data + "\n";
}

}  // namespace fastball::launch
