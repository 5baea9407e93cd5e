#pragma once

#include <optional>

#include "vision_tracker/flight_landing.h"
#include "vision_tracker/ring_pose.h"

namespace fastball::vision_tracker {

/// Where a flight crosses the plane of a ring that the same cameras measured, in the ring's own
/// coordinates. An error of a camera's calibration moves both alike, by K = d landing / d
/// constants. What the residuals of both say of the constants c (the cameras disagree about
/// heights) is taken into account: with their covariance P given that and the calibration's own,
///   landing - K c,   cov = noise of the flight + noise of the ring + K P K^T.
/// @param inner_radius [m]
/// @return nothing as landingOf() of a known target
std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const RingEstimate& ring,
                                         double inner_radius,
                                         const FlightPrior& flight_prior,
                                         const RingPrior& ring_prior);

}  // namespace fastball::vision_tracker
