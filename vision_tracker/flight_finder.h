#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/ball_flight.h"
#include "model/camera.h"
#include "vision_tracker/ball_fit.h"

namespace fastball::vision_tracker {

/// Ball-like things in one image.
struct CameraSightings {
  int camera = 0;
  int64_t utime = 0;  ///< [us]
  std::vector<BallFit> fits;
};
/// Those of one moment.
using Sightings = std::vector<CameraSightings>;

/// What one camera saw of a point.
struct PointView {
  int64_t utime = 0;  ///< [us]
  int camera = 0;
  BallFit fit;
};

/// A point that two cameras agree on, or that one alone places by the ball's size.
struct SpatialPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  std::vector<PointView> views;
  /// Direction [1] in which its place is poorly known, as one camera's size leaves it, and how poorly [m] at most.
  Eigen::Vector3d doubtful_W = Eigen::Vector3d::Zero();
  double doubt = 0;
};

/// Looks for something that flies: among the points of the last twelve times, six or more that lie
/// on one free fall at 1 to 20 m/s, which where two cameras see them must show in their heights. A
/// point is a pair of things in two cameras that lie on one point of space within 2 px and have the
/// size of the ball there, to 15 %. Where two cameras have no image of one instant, the things in
/// the one that came later are taken, on the line between its image before and its image after, at
/// the time of the other; where the clocks are uncertain, the 2 px grow by what the thing moves
/// meanwhile. A single camera's points come from centre and radius.
class FlightFinder {
 public:
  /// @param ball_radius [m] @param gravity [m/s^2]
  /// @param clock_sigma [s], of a camera's clock against the first one's; 0: one trigger for all
  FlightFinder(double ball_radius, double gravity, double clock_sigma);
  void reset();

  /// A flight found.
  struct Found {
    model::BallState state;            ///< at utime
    int64_t utime = 0;                 ///< [us], of the earliest point
    std::vector<SpatialPoint> points;  ///< in order of time
  };
  /// Adds the newest sightings and looks whether a flight ends in them. The cameras are the same in
  /// every call, until reset().
  std::optional<Found> add(const Sightings& sightings, const std::vector<model::Camera>& cameras);

 private:
  struct Moment {
    int64_t utime = 0;
    std::vector<SpatialPoint> points;
  };
  /// A thing in an image, and how it moves there.
  struct Thing {
    PointView seen;
    BallFit fit;                                         ///< where it was at the time asked for
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [px/s]
  };
  /// One image's things.
  struct Look {
    int64_t utime = 0;
    std::vector<BallFit> fits;
  };
  std::optional<Found> search() const;
  Found pointsOn(const model::BallState& state, int64_t utime) const;
  /// The newest things of a camera as they were at `utime`, between its last two images or at the last of them.
  std::vector<Thing> thingsAt(int camera, int64_t utime) const;
  void pair(const std::vector<Thing>& a,
            const std::vector<Thing>& b,
            const std::vector<model::Camera>& cameras,
            std::vector<SpatialPoint>& points) const;
  void placeAlone(const std::vector<Thing>& things,
                  const model::Camera& camera,
                  std::vector<SpatialPoint>& points) const;
  bool matches(const model::Camera& camera, const Thing& thing, const Eigen::Vector3d& p_W) const;
  std::vector<SpatialPoint>& pointsAt(int64_t utime);

  double ball_radius_, gravity_, clock_sigma_;
  std::deque<Moment> history_;           ///< in order of time
  std::vector<std::deque<Look>> looks_;  ///< of each camera
};

}  // namespace fastball::vision_tracker
