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

/// How well each camera's calibration is known: standard deviations per axis.
struct CalibrationSigma {
  double rotation = 0;      ///< [rad]
  double position = 0;      ///< [m]
  double focal_length = 0;  ///< relative
};

/// What is known of every flight before it is seen.
struct FlightPrior {
  double gravity = 0;      ///< [m/s^2]
  double drag = 0;         ///< [1/m]
  double drag_sigma = 0;   ///< [1/m]
  double ball_radius = 0;  ///< [m]
  /// [px], standard deviation of an error of the centres that stays the same through a flight, per camera and axis: what
  /// the shading leaves.
  double bias_sigma = 0;
  CalibrationSigma calibration = {};
};

/// A flight fitted to observations.
struct FlightEstimate {
  int64_t utime = 0;  ///< [us], time of `start`
  model::BallState start;
  double drag = 0;                                                        ///< [1/m]
  Eigen::Matrix<double, 7, 7> cov = Eigen::Matrix<double, 7, 7>::Zero();  ///< of (p, v, k) at utime
  double residual_px = 0;  ///< [px], rms per axis of the observations used
  /// Standard deviation of the residuals over that which the observations' covariances say; it is in `cov`. A few residuals
  /// hardly move it from 1.
  double scale = 1;
  int used = 0;  ///< observations that were not cut away

  model::BallState at(int64_t time, double gravity) const;
};

/// Robust maximum likelihood: Gauss-Newton on the pixels of all cameras over start and drag; Huber's weights at first, then
/// observations too far off are cut (the limit grows with the median residual, so that a bad start does not cut everything).
/// Errors that stay the same through a flight (biases, calibration) are not estimated, for the images of one flight hardly
/// show them, but carried into the covariance: cov = F^-1 + K S K^T with K = F^-1 sum J^T W G, where G is the derivative of
/// the centres by those errors and S their covariance ("consider parameters", Schmidt 1966).
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
