#pragma once

#include <Eigen/Core>
#include <string>

#include "config/experiment.h"
#include "model/camera.h"
#include "vision_tracker/throw_tracker.h"

namespace fastball::bench {

/// Flights seen by formula: the tracker's fit alone, without images.
struct FlightTrialOptions {
  int throws = 500;
  int seed = 1;
  double sigma = 0.1;   ///< [px], noise of a centre, per axis
  double seen = 1.0;    ///< share of the flight that is seen, from the release on
  double lost = 0;      ///< share of the images that are lost
  double outliers = 0;  ///< share of the centres that are up to `outlier_size` off, per axis
  double hidden_from = 0, hidden_to = 0;  ///< shares of the flight between which nothing is seen
  /// Errors of the cameras' calibration, drawn for each throw and camera; tell the tracker's prior of them too.
  vision_tracker::CalibrationSigma calibration;
  double outlier_size = 20;  ///< [px]
};

/// Their landings against the truth.
struct FlightTrialResult {
  int throws = 0;
  int failures = 0;  ///< the fit gave no landing
  double rms = 0;    ///< [m], of the landing error, both axes
  /// [m], root of the mean trace of the bound of these very flights, nothing lost and no outliers.
  double bound = 0;
  double nees = 0;    ///< mean normalised error squared; 2 if the covariance is right
  double inside = 0;  ///< share of true landings inside the stated 95 % ellipse
  double ratio() const { return rms / bound; }
};

/// Cameras, release places and drags of the default experiment; the drag, and the clocks if they are uncertain, are
/// drawn from what the tracker assumes of them.
/// @param options `tracker` as the process has them
FlightTrialResult flightTrials(const std::vector<model::Camera>& cameras,
                               double rate,
                               const config::Experiment& experiment,
                               const vision_tracker::TrackerOptions& tracker,
                               const FlightTrialOptions& options);

}  // namespace fastball::bench
