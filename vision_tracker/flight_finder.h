#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/ball_flight.h"
#include "model/camera.h"
#include "vision_tracker/ball_fit.h"

namespace fastball::vision_tracker {

/// Ball-like things that all cameras saw at one time.
struct Sightings {
  int64_t utime = 0;  ///< [us]
  std::vector<std::vector<BallFit>> by_camera;
};

/// A point that two cameras agree on.
struct SpatialPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  int cameras[2] = {0, 0};
  BallFit fits[2];
};

/// Pairs of things in two cameras that lie on one point of space within 2 px and have the size of the ball there.
std::vector<SpatialPoint> spatialPoints(const Sightings& sightings,
                                        const std::vector<model::Camera>& cameras,
                                        double ball_radius);

/// Looks for something that flies: among the points of the last ten times, some that lie on one free fall.
class FlightFinder {
 public:
  FlightFinder(double ball_radius, double gravity);
  void reset() { history_.clear(); }

  /// A flight found.
  struct Found {
    model::BallState state;                                ///< at utime
    int64_t utime = 0;                                     ///< [us], of the earliest point
    std::vector<std::pair<int64_t, SpatialPoint>> points;  ///< in order of time
  };
  /// Adds the newest sightings and looks whether a flight ends in them.
  std::optional<Found> add(const Sightings& sightings, const std::vector<model::Camera>& cameras);

 private:
  struct Moment {
    int64_t utime = 0;
    std::vector<SpatialPoint> points;
  };
  Found pointsOn(const model::BallState& state, int64_t utime) const;

  double ball_radius_, gravity_;
  std::deque<Moment> history_;
};

}  // namespace fastball::vision_tracker
