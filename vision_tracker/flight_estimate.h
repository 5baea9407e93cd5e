#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/ball_flight.h"
#include "vision_tracker/camera_constants.h"

namespace fastball::vision_tracker {

/// [s], between two times in microseconds.
inline double seconds(int64_t from, int64_t to) {
  return static_cast<double>(to - from) * 1e-6;
}

/// What a flight is determined by: position, velocity, drag.
constexpr int kFlightParameters = 7;
using FlightVector = Eigen::Matrix<double, kFlightParameters, 1>;
using FlightCovariance = Eigen::Matrix<double, kFlightParameters, kFlightParameters>;
using FlightGain = Eigen::Matrix<double, kFlightParameters, kCameraConstants>;

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
  /// the shading leaves.
  double bias_sigma = 0;
  CalibrationSigma calibration = {};
};

/// A flight fitted to observations.
struct FlightEstimate {
  int64_t utime = 0;  ///< [us], time of `start`
  model::BallState start;
  double drag = 0;                                  ///< [1/m]
  FlightCovariance cov = FlightCovariance::Zero();  ///< of (p, v, k) at utime
  /// The part of `cov` that noise and the drag's prior make: without the errors that stay the same through a flight.
  FlightCovariance noise_cov = FlightCovariance::Zero();
  /// Of each camera: d (p, v, k) / d its constants. cov = noise_cov + sum gain S gain^T.
  std::vector<FlightGain> gains;
  double residual_px = 0;  ///< [px], rms per axis of the observations used
  /// Standard deviation of the residuals over that which the observations' covariances say; it is in `cov`. A few residuals
  /// hardly move it from 1.
  double scale = 1;
  int used = 0;  ///< observations that were not cut away

  model::BallState at(int64_t time, double gravity) const;
};

}  // namespace fastball::vision_tracker
