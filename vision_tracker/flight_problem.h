#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/camera.h"
#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

/// One flight fitted to observations by Gauss-Newton: the residuals, the steps and what comes out.
class FlightProblem {
 public:
  /// All references must outlive the problem. @param first use the observations from this index on
  FlightProblem(const std::vector<Observation>& observations,
                std::size_t first,
                const std::vector<model::Camera>& cameras,
                const FlightPrior& prior);

  /// [us], of the flight's start.
  int64_t utime() const { return observations_[first_].utime; }
  void start(const model::BallState& state, double drag);
  /// Residuals at the present parameters. False if the flight leaves the space before a camera.
  bool evaluate();
  /// Solves for one step. @param cutting far observations are left out, else they weigh less (Huber)
  /// @return information
  FlightCovariance step(bool cutting, FlightVector* change) const;
  void move(const FlightVector& change) { x_ += change; }
  /// @param information of the last step, cutting
  FlightEstimate estimate(FlightCovariance information) const;

 private:
  /// One observation against the flight assumed.
  struct Residual {
    Eigen::Vector2d error;                                 ///< [px]
    Eigen::Matrix<double, 2, kFlightParameters> jacobian;  ///< of the predicted centre
    Eigen::Matrix<double, 2, kCameraConstants> constants;  ///< d centre / d its camera's constants
    Eigen::Matrix2d weight;                                ///< inverse covariance
    double distance = 0;                                   ///< Mahalanobis
  };
  double weight(const Residual& residual, bool cutting) const;
  double dragWeight() const { return 1 / (prior_.drag_sigma * prior_.drag_sigma); }
  std::vector<FlightGain> constantSums() const;

  const std::vector<Observation>& observations_;
  std::size_t first_;
  const std::vector<model::Camera>& cameras_;
  const FlightPrior& prior_;
  std::vector<Residual> residuals_;
  FlightVector x_ = FlightVector::Zero();
  double spread_ = 1;
};

}  // namespace fastball::vision_tracker
