#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/ball_fit.h"
#include "vision_tracker/flight_landing.h"

namespace fastball::vision_tracker {

/// Holds the ball's size in the images against its distance by the flight. Calibrations that are swapped, or of other cameras, often
/// let a flight through all rays be found; but it passes at a wrong distance, and there a ball of known radius has another size.
class SizeCheck {
 public:
  void reset() { seen_.clear(); }
  void add(int camera, int64_t utime, const BallFit& fit);
  /// How much larger the ball looks than it should, relative: of each camera the median over the last third of a second before the
  /// landing, and of these the one farthest from zero. Cameras with fewer than eight sightings are left out; nothing if all are.
  std::optional<double> excess(const LandingEstimate& landing,
                               const std::vector<model::Camera>& cameras,
                               const FlightPrior& prior) const;

  /// Why the landing cannot be this ball's, as a part of a sentence: the excess is kTolerance or
  /// more, either way. An empty text if nothing speaks against it.
  std::string fault(const LandingEstimate& landing,
                    const std::vector<model::Camera>& cameras,
                    const FlightPrior& prior) const;

  /// Blur, shading and what hides a part of the ball change its size by less.
  static constexpr double kTolerance = 0.05;

 private:
  struct Seen {
    int64_t utime;  ///< [us]
    int camera;
    double radius;  ///< [px]
  };
  std::vector<Seen> seen_;
};

}  // namespace fastball::vision_tracker
