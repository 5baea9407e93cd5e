#include "vision_tracker/flight_finder.h"

#include <Eigen/LU>
#include <cmath>
#include <iterator>

#include "vision_tracker/flight_estimate.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr std::size_t kMoments = 12;  // 50 ms at 240 Hz
constexpr std::size_t kLeastPoints = 6;
constexpr double kLargestMiss = 2.0;        // [px], reprojection
constexpr double kLargestSizeError = 0.15;  // of the ball's radius in the image
constexpr double kTolerance = 0.012;  // [m], of a point from the flight: drag and triangulation
constexpr double kDepthTolerance =
    0.04;  // of the distance, of a point that one camera places by its size
constexpr double kLongestLink = 0.1;  // [s], between two images in which a thing is the same
constexpr double kClockSigmas = 3;    // as far as clocks are allowed to be off
constexpr std::size_t kLooks = 3;
constexpr double kSlowest = 1.0;   // [m/s]
constexpr double kFastest = 20.0;  // [m/s]

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

/// The thing that `fit` was in an earlier image: the nearest of about its size.
const BallFit* earlier(const BallFit& fit, const std::vector<BallFit>& before) {
  const BallFit* nearest = nullptr;
  for (const BallFit& other : before) {
    if (std::abs(other.radius / fit.radius - 1) > 2 * kLargestSizeError)
      continue;
    if (nearest == nullptr ||
        (other.centre - fit.centre).norm() < (nearest->centre - fit.centre).norm())
      nearest = &other;
  }
  return nearest;
}

/// Whether the points fall as free things do: a ball that rolls, hangs or is carried keeps to the same tolerance over so short a
/// time, but its height has another curvature.
bool falls(const std::vector<SpatialPoint>& points, double gravity) {
  constexpr double kShare = 0.4;  // of gravity, by which the measured one may differ
  constexpr double kSure = 0.15;  // of gravity, standard deviation of the measured one at most
  constexpr double kLeastNoise = 1e-4;  // [m], of a height
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count < 4)
    return false;
  if (points.front().views.size() < 2)
    return true;  // a single camera's depths are too rough to tell
  Eigen::MatrixX3d powers(count, 3);
  Eigen::VectorXd heights(count);
  const int64_t middle =
      (points.front().views.front().utime + points.back().views.front().utime) / 2;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SpatialPoint& point = points[static_cast<std::size_t>(i)];
    const double t = static_cast<double>(point.views.front().utime - middle) * 1e-6;
    powers.row(i) << 1, t, -t * t / 2;
    heights[i] = point.p_W.z();
  }
  const Eigen::Matrix3d inverse = (powers.transpose() * powers).inverse();
  const Eigen::Vector3d fit = inverse * (powers.transpose() * heights);
  const double noise = std::max(
      kLeastNoise, (heights - powers * fit).norm() / std::sqrt(static_cast<double>(count - 3)));
  return std::abs(fit[2] - gravity) < kShare * gravity &&
         noise * std::sqrt(inverse(2, 2)) < kSure * gravity;
}

}  // namespace

FlightFinder::FlightFinder(double ball_radius, double gravity, double clock_sigma)
    : ball_radius_(ball_radius), gravity_(gravity), clock_sigma_(clock_sigma) {}

void FlightFinder::reset() {
  history_.clear();
  looks_.clear();
}

std::vector<FlightFinder::Thing> FlightFinder::thingsAt(int camera, int64_t utime) const {
  const std::deque<Look>& looks = looks_[static_cast<std::size_t>(camera)];
  const Look& last = looks.back();
  const Look* before = looks.size() > 1 ? &looks[looks.size() - 2] : nullptr;
  const double gap = before != nullptr ? seconds(before->utime, last.utime) : 0;
  std::vector<Thing> things;
  for (const BallFit& fit : last.fits) {
    Thing thing{{last.utime, camera, fit}, fit};
    const BallFit* past = gap > 0 && gap < kLongestLink ? earlier(fit, before->fits) : nullptr;
    if (past != nullptr)
      thing.velocity = (fit.centre - past->centre) / gap;
    else if (utime != last.utime)
      continue;
    thing.fit.centre += thing.velocity * seconds(last.utime, utime);
    things.push_back(thing);
  }
  return things;
}

bool FlightFinder::matches(const model::Camera& camera,
                           const Thing& thing,
                           const Eigen::Vector3d& p_W) const {
  const Outline outline = sphereOutline(camera, p_W, ball_radius_);
  const double miss = kLargestMiss + kClockSigmas * clock_sigma_ * thing.velocity.norm();
  return (outline.centre - thing.fit.centre).norm() < miss &&
         std::abs(thing.fit.radius / outline.meanRadius() - 1) < kLargestSizeError;
}

void FlightFinder::pair(const std::vector<Thing>& a,
                        const std::vector<Thing>& b,
                        const std::vector<model::Camera>& cameras,
                        std::vector<SpatialPoint>& points) const {
  for (const Thing& one : a) {
    for (const Thing& other : b) {
      const model::Camera& camera = cameras[static_cast<std::size_t>(one.seen.camera)];
      const model::Camera& second = cameras[static_cast<std::size_t>(other.seen.camera)];
      const auto p_W = between(camera, one.fit.centre, second, other.fit.centre);
      if (p_W && matches(camera, one, *p_W) && matches(second, other, *p_W))
        points.push_back({*p_W, {one.seen, other.seen}});
    }
  }
}

void FlightFinder::placeAlone(const std::vector<Thing>& things,
                              const model::Camera& camera,
                              std::vector<SpatialPoint>& points) const {
  for (const Thing& thing : things) {
    const auto place = placeBySize(camera, thing.fit.centre, thing.fit.radius, ball_radius_);
    if (!place)
      continue;
    points.push_back({place->p_W, {thing.seen}, place->along_W, kDepthTolerance * place->depth});
  }
}

FlightFinder::Found FlightFinder::pointsOn(const model::BallState& state, int64_t utime) const {
  Found found;
  found.state = state;
  found.utime = utime;
  for (const Moment& moment : history_) {
    const double t = seconds(utime, moment.utime);
    if (t < 0)
      continue;
    const Eigen::Vector3d p_W =
        state.p_WBall + t * state.v_WBall - Eigen::Vector3d(0, 0, gravity_ * t * t / 2);
    for (const SpatialPoint& point : moment.points) {
      const Eigen::Vector3d off = point.p_W - p_W;
      const double along = off.dot(point.doubtful_W);
      const Eigen::Vector3d across = off - along * point.doubtful_W;
      if (across.norm() < kTolerance && std::abs(along) <= point.doubt) {
        found.points.push_back(point);
        break;
      }
    }
  }
  return found;
}

std::vector<SpatialPoint>& FlightFinder::pointsAt(int64_t utime) {
  auto place = history_.end();
  while (place != history_.begin() && std::prev(place)->utime >= utime)
    --place;
  if (place == history_.end() || place->utime != utime)
    place = history_.insert(place, Moment{utime, {}});
  return place->points;
}

std::optional<FlightFinder::Found> FlightFinder::add(const Sightings& sightings,
                                                     const std::vector<model::Camera>& cameras) {
  looks_.resize(cameras.size());
  std::vector<int> fresh;
  for (const CameraSightings& seen : sightings) {
    std::deque<Look>& looks = looks_[static_cast<std::size_t>(seen.camera)];
    looks.push_back({seen.utime, seen.fits});
    if (looks.size() > kLooks)
      looks.pop_front();
    fresh.push_back(seen.camera);
  }
  for (const int i : fresh) {
    const int64_t utime = looks_[static_cast<std::size_t>(i)].back().utime;
    if (cameras.size() == 1)
      placeAlone(thingsAt(i, utime), cameras.front(), pointsAt(utime));
    for (int j = 0; j < static_cast<int>(cameras.size()); ++j) {
      const std::deque<Look>& other = looks_[static_cast<std::size_t>(j)];
      if (j == i || other.empty())
        continue;
      const std::deque<Look>& own = looks_[static_cast<std::size_t>(i)];
      if (std::abs(other.back().utime - utime) <= kSameMoment) {
        if (i < j)
          pair(thingsAt(i, utime), thingsAt(j, other.back().utime), cameras, pointsAt(utime));
      } else if (own.size() > 1 && own[own.size() - 2].utime < other.back().utime) {
        // The other's last image lies between this camera's last two.
        const int64_t then = other.back().utime;
        pair(thingsAt(j, then), thingsAt(i, then), cameras, pointsAt(then));
      }
    }
  }
  while (history_.size() > kMoments)
    history_.pop_front();
  return history_.empty() ? std::nullopt : search();
}

std::optional<FlightFinder::Found> FlightFinder::search() const {
  const Moment& last = history_.back();
  // The longest flights first: they say most.
  for (std::size_t i = 0; i + kLeastPoints <= history_.size(); ++i) {
    const double t = seconds(history_[i].utime, last.utime);
    for (const SpatialPoint& from : history_[i].points) {
      for (const SpatialPoint& to : last.points) {
        const Eigen::Vector3d v_W =
            (to.p_W - from.p_W) / t + Eigen::Vector3d(0, 0, gravity_ * t / 2);
        if (!(v_W.norm() > kSlowest && v_W.norm() < kFastest))
          continue;
        Found found = pointsOn({from.p_W, v_W}, history_[i].utime);
        if (found.points.size() >= kLeastPoints && falls(found.points, gravity_))
          return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace fastball::vision_tracker
