#pragma once

#include <optional>

#include "vision_tracker/flight_landing.h"
#include "vision_tracker/ring_pose.h"

namespace fastball::vision_tracker {

/// Where a flight crosses the plane of a ring that the same cameras measured, in the ring's own coordinates. An error of a
/// camera's calibration moves the flight and the ring alike: with K = d landing / d constants of both together,
///   cov = noise of the flight + noise of the ring + sum over cameras of K S K^T.
/// Nothing as landingOf of a known target.
std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const RingEstimate& ring,
                                         double inner_radius,
                                         const FlightPrior& flight_prior,
                                         const RingPrior& ring_prior);

}  // namespace fastball::vision_tracker
