#include "vision_tracker/pixel_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastball::vision_tracker {
namespace {

constexpr int kImagesToLearn = 4;
constexpr int kMostMisses = 3;  // images in a row without the ball, before its path ends
constexpr std::size_t kLeastSightings = 4;
constexpr double kLeastWay = 4;     // radii, of a path from end to end
constexpr double kFirstReach = 14;  // radii between a path's first two sightings
constexpr double kSizeRatio =
    1.6;  // between the longest path's ball and that of another of the same ball
constexpr double kBlur = 0.8;  // [px], standard deviation of lens and pixel together
constexpr double kReach = 3;   // radii about the predicted place

/// A camera so far away that a ball is a circle wherever it is in the image. The ball has a radius of 1.
model::Camera distantCamera(const cv::Size& size) {
  model::Camera camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = camera.fy = 1e6;
  camera.cx = (size.width - 1) / 2.0;
  camera.cy = (size.height - 1) / 2.0;
  return camera;
}

DetectorOptions detectorOptions(const model::Camera& camera, const PixelTrackerOptions& options) {
  DetectorOptions detector;
  detector.ball_radius = 1;
  detector.nearest = camera.fx / options.largest;
  detector.farthest = camera.fx / options.smallest;
  detector.blur = kBlur;
  detector.noise_floor = 0.05;
  detector.keep_uneven = true;
  return detector;
}

/// [px], the radius in the middle of a path's.
double usualRadius(const std::vector<PixelSighting>& sightings) {
  std::vector<double> radii;
  for (const PixelSighting& s : sightings)
    radii.push_back(s.fit.radius);
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

double extent(const std::vector<PixelSighting>& sightings) {
  double most = 0;
  for (const PixelSighting& s : sightings)
    most = std::max(most, (s.fit.centre - sightings.front().fit.centre).norm());
  return most;
}

}  // namespace

PixelTracker::PixelTracker(const cv::Size& size, const PixelTrackerOptions& options)
    : options_(options),
      detector_(distantCamera(size), 0, detectorOptions(distantCamera(size), options)) {}

Eigen::Vector2d PixelTracker::predicted(const Path& path, double time) const {
  const std::size_t n = path.sightings.size();
  const PixelSighting& c = path.sightings[n - 1];
  if (n < 2)
    return c.fit.centre;
  const PixelSighting& b = path.sightings[n - 2];
  const Eigen::Vector2d v_bc = (c.fit.centre - b.fit.centre) / (c.time - b.time);
  const double ahead = time - c.time;
  if (n < 3)
    return c.fit.centre + ahead * v_bc;
  const PixelSighting& a = path.sightings[n - 3];
  const Eigen::Vector2d v_ab = (b.fit.centre - a.fit.centre) / (b.time - a.time);
  const Eigen::Vector2d acceleration = 2 * (v_bc - v_ab) / (c.time - a.time);
  return c.fit.centre + ahead * v_bc + acceleration * ahead * (ahead + c.time - b.time) / 2;
}

double PixelTracker::gate(const Path& path, double time) const {
  const PixelSighting& last = path.sightings.back();
  if (path.sightings.size() == 1)
    return kFirstReach * last.fit.radius;
  return kReach * last.fit.radius + 0.2 * (predicted(path, time) - last.fit.centre).norm();
}

bool PixelTracker::extends(const Path& path,
                           const BallFit& fit,
                           double time,
                           double& distance) const {
  const double radius = path.sightings.back().fit.radius;
  distance = (fit.centre - predicted(path, time)).norm();
  return distance < gate(path, time) && fit.radius < 1.5 * radius && fit.radius > radius / 1.5;
}

void PixelTracker::add(const cv::Mat& image, double time) {
  const int frame = frame_++;
  std::vector<BallFit> found;
  if (background_.images() >= kImagesToLearn)
    found = detector_.search(image, background_);
  background_.learn(image, {});
  std::vector<bool> taken(found.size(), false);
  // The longest path chooses first.
  std::stable_sort(open_.begin(), open_.end(), [](const Path& a, const Path& b) {
    return a.sightings.size() > b.sightings.size();
  });
  for (Path& path : open_) {
    std::size_t best = found.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < found.size(); ++i) {
      double distance = 0;
      if (!taken[i] && extends(path, found[i], time, distance) && distance < nearest) {
        best = i;
        nearest = distance;
      }
    }
    if (best < found.size()) {
      taken[best] = true;
      path.sightings.push_back({frame, time, found[best]});
    }
  }
  const auto ended = std::stable_partition(open_.begin(), open_.end(), [&](const Path& path) {
    return frame - path.sightings.back().frame <= kMostMisses;
  });
  std::move(ended, open_.end(), std::back_inserter(closed_));
  open_.erase(ended, open_.end());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!taken[i])
      open_.push_back({{{frame, time, found[i]}}});
}

std::vector<PixelSighting> PixelTracker::track() const {
  std::vector<Path> paths = closed_;
  paths.insert(paths.end(), open_.begin(), open_.end());
  const auto useless = [](const Path& path) {
    return path.sightings.size() < kLeastSightings ||
           extent(path.sightings) < kLeastWay * path.sightings.front().fit.radius;
  };
  paths.erase(std::remove_if(paths.begin(), paths.end(), useless), paths.end());
  std::stable_sort(paths.begin(), paths.end(), [](const Path& a, const Path& b) {
    return a.sightings.size() > b.sightings.size();
  });
  const double radius = paths.empty() ? 0 : usualRadius(paths.front().sightings);
  const auto another = [radius](const Path& path) {
    const double ratio = usualRadius(path.sightings) / radius;
    return ratio > kSizeRatio || ratio < 1 / kSizeRatio;
  };
  paths.erase(std::remove_if(paths.begin(), paths.end(), another), paths.end());
  std::vector<PixelSighting> track;
  std::vector<bool> seen(static_cast<std::size_t>(frame_), false);
  for (const Path& path : paths) {
    std::vector<PixelSighting> fresh;
    for (const PixelSighting& s : path.sightings) {
      if (!seen[static_cast<std::size_t>(s.frame)])
        fresh.push_back(s);
    }
    // What little of a path is not beside a longer one is no path.
    if (fresh.size() < kLeastSightings)
      continue;
    track.insert(track.end(), fresh.begin(), fresh.end());
    for (int f = path.sightings.front().frame; f <= path.sightings.back().frame; ++f)
      seen[static_cast<std::size_t>(f)] = true;
  }
  std::sort(track.begin(), track.end(),
            [](const PixelSighting& a, const PixelSighting& b) { return a.frame < b.frame; });
  return track;
}

}  // namespace fastball::vision_tracker
