#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/ball_flight.h"
#include "vision_tracker/camera_constants.h"
#include "vision_tracker/flight_path.h"

namespace fastball::vision_tracker {

/// [us], images of several cameras no farther apart than this are of one moment.
inline constexpr int64_t kSameMoment = 500;

/// [s], between two times in microseconds.
inline double seconds(int64_t from, int64_t to) {
  return static_cast<double>(to - from) * 1e-6;
}

using FlightVector = Eigen::Matrix<double, kFlightParameters, 1>;
using FlightCovariance = Eigen::Matrix<double, kFlightParameters, kFlightParameters>;
using FlightGain = Eigen::Matrix<double, kFlightParameters, kCameraConstants>;

/// The centre of the ball's outline, seen by one camera at one time.
struct Observation {
  int64_t utime = 0;                                 ///< [us]
  int camera = 0;                                    ///< index
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();     ///< [px^2]
  double radius = 0;                                 ///< [px], mean radius of the outline
  double radius_variance = 0;                        ///< [px^2]; 0: the radius was not measured
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
  /// [s], standard deviation of each camera's clock against the first one's; 0: one trigger for all. Estimated.
  double clock_sigma = 0;
  /// [1/s], standard deviation per axis of the lift S of a spinning ball, a += S x v; 0: none. Estimated.
  double magnus_sigma = 0;
  /// Relative, standard deviation of an error that all measured radii of a flight share, and [1/s] of its change on the way.
  /// Estimated; only a single camera's radii are used.
  double radius_sigma = 0.01;
};

/// A flight fitted to observations.
struct FlightEstimate {
  int64_t utime = 0;  ///< [us], time of `start`, by the first camera's clock
  model::BallState start;
  double drag = 0;                                 ///< [1/m]
  Eigen::Vector3d lift = Eigen::Vector3d::Zero();  ///< S [1/s]
  /// Of (p, v, k, S) at utime.
  FlightCovariance cov = FlightCovariance::Zero();
  /// The part of `cov` that noise and the priors make: without the errors that stay the same through a flight.
  FlightCovariance noise_cov = FlightCovariance::Zero();
  /// Of each camera: d (p, v, k, S) / d its constants. cov = noise_cov + sum gain C gain^T, with C
  /// the constants' variances (constantVariances()).
  std::vector<FlightGain> gains;
  /// [s], of each camera: how far its clock is ahead of the first one's, and the standard deviation of that.
  std::vector<double> clock, clock_sigma;
  ConstantsEvidence evidence;  ///< what the residuals say of the cameras' constants
  double residual_px = 0;      ///< [px], rms per axis of the observations used
  /// Standard deviation of the residuals over that which the observations' covariances say; it is in `cov`. A few residuals
  /// hardly move it from 1.
  double scale = 1;
  /// The same without what errors of the cameras' constants, as far as they are to be expected, explain of the residuals.
  double quiet_scale = 1;
  int used = 0;  ///< observations that were not cut away

  /// The ball at a time [us] of the first camera's clock. @param gravity [m/s^2]
  model::BallState at(int64_t time, double gravity) const;
  /// From one state of this flight to another, `duration` [s] later.
  model::BallState onward(const model::BallState& state, double duration, double gravity) const;
  /// [s], from the flight's start to what a camera's clock calls `time`.
  double sinceStart(int64_t time, int camera) const;
};

}  // namespace fastball::vision_tracker
