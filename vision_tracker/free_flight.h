#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// fitFlight() that finds where free flight begins: fits the later half, then goes back in time as long as the observations
/// agree with the flight. Observations of the ball in the hand do not.
/// @param begin index of the first observation used
std::optional<FlightEstimate> fitFreeFlight(const std::vector<Observation>& observations,
                                            const std::vector<model::Camera>& cameras,
                                            const FlightPrior& prior,
                                            const model::BallState& guess,
                                            int64_t guess_utime,
                                            std::size_t* begin);

}  // namespace fastball::vision_tracker
