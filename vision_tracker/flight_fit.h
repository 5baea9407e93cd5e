#pragma once

#include <optional>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// Robust maximum likelihood: Gauss-Newton on the pixels of all cameras over start and drag, and
/// over lift, clocks and the error of a single camera's radii where the prior gives them room;
/// Huber's weights at first, then observations too far off are cut (the limit grows with the median
/// residual, so that a bad start does not cut everything). Errors that stay the same through a
/// flight (biases, calibration) are not estimated, for the images of one flight hardly show them,
/// but carried into the covariance: cov = F^-1 + K C K^T with K = F^-1 sum J^T W G, where G is the
/// derivative of the centres by those errors and C their covariance ("consider parameters", S. F.
/// Schmidt, "Application of state-space methods to navigation problems", 1966).
/// @param observations in order of time; @param first use those from this index on
/// @param guess start, at guess_utime [us]; drag begins at the prior
/// @return nothing if it does not converge, the flight leaves the space before a camera, or fewer
///   than eight observations are left
/// @throw std::invalid_argument for more than model::kMostCameras cameras
std::optional<FlightEstimate> fitFlight(const std::vector<Observation>& observations,
                                        std::size_t first,
                                        const std::vector<model::Camera>& cameras,
                                        const FlightPrior& prior,
                                        const model::BallState& guess,
                                        int64_t guess_utime);

/// The same from a flight that a few observations fewer have given: nothing is far off any more, so it cuts from the first step.
std::optional<FlightEstimate> refitFlight(const std::vector<Observation>& observations,
                                          std::size_t first,
                                          const std::vector<model::Camera>& cameras,
                                          const FlightPrior& prior,
                                          const FlightEstimate& last);

}  // namespace fastball::vision_tracker
