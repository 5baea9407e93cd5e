#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/target.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

using LandingGain = Eigen::Matrix<double, 2, kCameraConstants>;

/// Where a flight crosses the target plane.
struct LandingEstimate {
  int64_t utime = 0;                                    ///< [us]
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();    ///< [m], plane coordinates (right, up)
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();        ///< [m^2]
  Eigen::Matrix2d noise_cov = Eigen::Matrix2d::Zero();  ///< [m^2], FlightEstimate::noise_cov's part
  std::vector<LandingGain> gains;  ///< of each camera, d landing / d its constants
  model::BallState state;          ///< at the crossing
};
/// Nothing if the plane is not crossed from its front within 3 s of the flight's start, or at less
/// than 1 mm/s across it. @param gravity [m/s^2]
std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity);

}  // namespace fastball::vision_tracker
