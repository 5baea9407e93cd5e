#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/ball_flight.h"
#include "model/camera.h"
#include "model/target.h"

namespace fastball::vision_tracker {

/// The centre of the ball's outline, seen by one camera at one time.
struct Observation {
  int64_t utime = 0;                                 ///< [us]
  int camera = 0;                                    ///< index
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();     ///< [px^2]
};

/// What is known of every flight before it is seen.
struct FlightPrior {
  double gravity = 0;      ///< [m/s^2]
  double drag = 0;         ///< [1/m]
  double drag_sigma = 0;   ///< [1/m]
  double ball_radius = 0;  ///< [m]
  /// [px], standard deviation of an error of the centres that stays the same through a flight, per camera and axis: what
  /// is left of the calibration's and the shading's. The estimate carries it as unknowns, so that its covariance is honest.
  double bias_sigma = 0;
  /// Errors of so many images of a camera in a row are alike (the same shading before the same background), so that they
  /// tell no more than one.
  double alike = 1;
};

/// A flight fitted to observations.
struct FlightEstimate {
  int64_t utime = 0;  ///< [us], time of `start`
  model::BallState start;
  double drag = 0;                                                        ///< [1/m]
  Eigen::Matrix<double, 7, 7> cov = Eigen::Matrix<double, 7, 7>::Zero();  ///< of (p, v, k) at utime
  double residual_px = 0;  ///< [px], rms per axis of the observations used
  double scale =
      1;  ///< standard deviation of the residuals over that expected, at least 1; it is in `cov`
  int used = 0;  ///< observations that were not cut away

  model::BallState at(int64_t time, double gravity) const;
};

/// Robust maximum likelihood: Gauss-Newton on the pixels of all cameras over start, drag and the cameras' biases; Huber's weights
/// at first, then observations too far off are cut (the limit grows with the median residual, so that a bad start
/// does not cut everything).
/// @param observations in order of time; @param first use those from this index on
/// @param guess start, at guess_utime; drag begins at the prior
/// @return nothing if it does not converge, or less than eight observations are left.
std::optional<FlightEstimate> fitFlight(const std::vector<Observation>& observations,
                                        std::size_t first,
                                        const std::vector<model::Camera>& cameras,
                                        const FlightPrior& prior,
                                        const model::BallState& guess,
                                        int64_t guess_utime);

/// The same, and finds where free flight begins: fits the later half, then goes back in time as long as the observations
/// agree with the flight. Observations of the ball in the hand do not.
/// @param begin index of the first observation used
std::optional<FlightEstimate> fitFreeFlight(const std::vector<Observation>& observations,
                                            const std::vector<model::Camera>& cameras,
                                            const FlightPrior& prior,
                                            const model::BallState& guess,
                                            int64_t guess_utime,
                                            std::size_t* begin);

/// Where a flight crosses the target plane.
struct LandingEstimate {
  int64_t utime = 0;                                  ///< [us]
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();  ///< [m], plane coordinates
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();      ///< [m^2]
  model::BallState state;
};
/// Nothing if the plane is not crossed from the robot's side within 3 s.
std::optional<LandingEstimate> landingOf(const FlightEstimate& flight,
                                         const model::Target& target,
                                         double gravity);

}  // namespace fastball::vision_tracker
