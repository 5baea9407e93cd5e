#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/ball_flight.h"
#include "model/camera.h"
#include "model/target.h"

namespace fastball::bench {

/// A camera sees the ball's centre once, with an error of its own.
struct View {
  double time = 0;   ///< [s] after the start of the flight
  int camera = 0;    ///< index
  double sigma = 0;  ///< [px], standard deviation per axis
};

/// What is known of a flight beside the views.
struct FlightKnowledge {
  double gravity = 0;      ///< [m/s^2]
  double drag = 0;         ///< [1/m], true
  double drag_sigma = 0;   ///< [1/m], of what is known of it beforehand
  double ball_radius = 0;  ///< [m]
  double clock_sigma = 0;  ///< [s], of each camera's clock against the first one's; 0: they are one
};

/// The Cramer-Rao bound of the landing: the covariance [m^2], in the target plane, below which no unbiased estimate of the
/// flight (start, velocity, drag, and where they are uncertain the clocks of all cameras but the first) from these views
/// comes. F = sum J^T J / sigma^2 + e_k e_k^T / sigma_k^2; bound = L F^-1 L^T. All derivatives are central differences of
/// model::fly, model::land and the outline's centre: nothing is shared with the tracker's own linearisation.
/// @param views in order of time
/// @throw std::invalid_argument if the flight does not reach the plane, or the views do not determine it
Eigen::Matrix2d landingBound(const model::BallState& start,
                             const std::vector<View>& views,
                             const std::vector<model::Camera>& cameras,
                             const model::Target& target,
                             const FlightKnowledge& knowledge);

}  // namespace fastball::bench
