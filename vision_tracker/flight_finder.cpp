#include "vision_tracker/flight_finder.h"

#include <Eigen/LU>
#include <cmath>

#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr std::size_t kMoments = 10;  // 42 ms at 240 Hz
constexpr std::size_t kLeastPoints = 6;
constexpr double kLargestMiss = 2.0;        // [px], reprojection
constexpr double kLargestSizeError = 0.15;  // of the ball's radius in the image
constexpr double kTolerance = 0.012;  // [m], of a point from the flight: drag and triangulation
constexpr double kSlowest = 1.0;      // [m/s]
constexpr double kFastest = 20.0;     // [m/s]

/// The point nearest to both cameras' rays.
std::optional<Eigen::Vector3d> between(const model::Camera& a,
                                       const Eigen::Vector2d& pixel_a,
                                       const model::Camera& b,
                                       const Eigen::Vector2d& pixel_b) {
  const auto ray = [](const model::Camera& camera, const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d n = camera.undistort(pixel);
    return (camera.R_CW.transpose() * Eigen::Vector3d(n.x(), n.y(), 1)).normalized().eval();
  };
  const Eigen::Vector3d d_a = ray(a, pixel_a), d_b = ray(b, pixel_b);
  const Eigen::Vector3d o_a = -a.R_CW.transpose() * a.p_CW, o_b = -b.R_CW.transpose() * b.p_CW;
  const Eigen::Matrix3d across_a = Eigen::Matrix3d::Identity() - d_a * d_a.transpose();
  const Eigen::Matrix3d across_b = Eigen::Matrix3d::Identity() - d_b * d_b.transpose();
  const Eigen::Matrix3d sum = across_a + across_b;
  if (!(sum.determinant() > 1e-6))
    return std::nullopt;  // parallel rays
  const Eigen::Vector3d p_W = sum.inverse() * (across_a * o_a + across_b * o_b);
  if (a.toCamera(p_W).z() < 0.1 || b.toCamera(p_W).z() < 0.1)
    return std::nullopt;
  return p_W;
}

bool matches(const model::Camera& camera,
             const BallFit& fit,
             const Eigen::Vector3d& p_W,
             double ball_radius) {
  const Outline outline = sphereOutline(camera, p_W, ball_radius);
  return (outline.centre - fit.centre).norm() < kLargestMiss &&
         std::abs(fit.radius / outline.meanRadius() - 1) < kLargestSizeError;
}

}  // namespace

std::vector<SpatialPoint> spatialPoints(const Sightings& sightings,
                                        const std::vector<model::Camera>& cameras,
                                        double ball_radius) {
  std::vector<SpatialPoint> points;
  for (std::size_t i = 0; i < sightings.by_camera.size(); ++i) {
    for (std::size_t j = i + 1; j < sightings.by_camera.size(); ++j) {
      for (const BallFit& a : sightings.by_camera[i]) {
        for (const BallFit& b : sightings.by_camera[j]) {
          const auto p_W = between(cameras[i], a.centre, cameras[j], b.centre);
          if (p_W && matches(cameras[i], a, *p_W, ball_radius) &&
              matches(cameras[j], b, *p_W, ball_radius))
            points.push_back({*p_W, {static_cast<int>(i), static_cast<int>(j)}, {a, b}});
        }
      }
    }
  }
  return points;
}

FlightFinder::FlightFinder(double ball_radius, double gravity)
    : ball_radius_(ball_radius), gravity_(gravity) {}

FlightFinder::Found FlightFinder::pointsOn(const model::BallState& state, int64_t utime) const {
  Found found;
  found.state = state;
  found.utime = utime;
  for (const Moment& moment : history_) {
    const double t = static_cast<double>(moment.utime - utime) * 1e-6;
    if (t < 0)
      continue;
    const Eigen::Vector3d p_W =
        state.p_WBall + t * state.v_WBall - Eigen::Vector3d(0, 0, gravity_ * t * t / 2);
    for (const SpatialPoint& point : moment.points) {
      if ((point.p_W - p_W).norm() < kTolerance) {
        found.points.emplace_back(moment.utime, point);
        break;
      }
    }
  }
  return found;
}

std::optional<FlightFinder::Found> FlightFinder::add(const Sightings& sightings,
                                                     const std::vector<model::Camera>& cameras) {
  history_.push_back({sightings.utime, spatialPoints(sightings, cameras, ball_radius_)});
  if (history_.size() > kMoments)
    history_.pop_front();
  const Moment& last = history_.back();
  // The longest flights first: they say most.
  for (std::size_t i = 0; i + kLeastPoints <= history_.size(); ++i) {
    const double t = static_cast<double>(last.utime - history_[i].utime) * 1e-6;
    for (const SpatialPoint& from : history_[i].points) {
      for (const SpatialPoint& to : last.points) {
        const Eigen::Vector3d v_W =
            (to.p_W - from.p_W) / t + Eigen::Vector3d(0, 0, gravity_ * t / 2);
        if (!(v_W.norm() > kSlowest && v_W.norm() < kFastest))
          continue;
        Found found = pointsOn({from.p_W, v_W}, history_[i].utime);
        if (found.points.size() >= kLeastPoints)
          return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace fastball::vision_tracker
