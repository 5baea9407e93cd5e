#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// fitFlight() that finds where free flight begins: fits the later half, then goes back in time as long as the observations
/// agree with the flight. Observations of the ball in the hand do not.
/// @param begin index of the first observation used; may be null
/// @return nothing as fitFlight()
std::optional<FlightEstimate> fitFreeFlight(const std::vector<Observation>& observations,
                                            const std::vector<model::Camera>& cameras,
                                            const FlightPrior& prior,
                                            const model::BallState& guess,
                                            int64_t guess_utime,
                                            std::size_t* begin);

/// A flight that is followed while observations come.
struct FreeFlight {
  FlightEstimate flight;
  std::size_t begin = 0;     ///< index of the first observation used
  std::size_t searched = 0;  ///< observations when the beginning was last looked for; 0: never
};

/// fitFreeFlight() of a flight that was known a few observations ago. It keeps the beginning and
/// starts from the last fit; it looks for the beginning again when the newest observations
/// disagree, and whenever their number has grown by a quarter.
std::optional<FreeFlight> followFreeFlight(const std::vector<Observation>& observations,
                                           const std::vector<model::Camera>& cameras,
                                           const FlightPrior& prior,
                                           const FreeFlight& last);

}  // namespace fastball::vision_tracker
