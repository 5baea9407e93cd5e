#pragma once

#include <Eigen/Core>

#include "model/ball_flight.h"

namespace fastball::vision_tracker {

/// Derivative of position and velocity with respect to (p0, v0, k).
using FlightSensitivity = Eigen::Matrix<double, 6, 7>;

/// A flight a = g - k |v| v followed through time, together with its derivative with respect to the start and the drag.
class FlightPath {
 public:
  FlightPath(const model::BallState& start, double drag_per_metre, double gravity);
  /// Moves to `time` [s] after the start (earlier times too): Runge-Kutta 4, steps of at most 5 ms.
  void moveTo(double time);
  const model::BallState& state() const { return state_; }
  const FlightSensitivity& sensitivity() const { return sensitivity_; }

 private:
  void step(double h);
  double drag_per_metre_, gravity_;
  double time_ = 0;
  model::BallState state_;
  FlightSensitivity sensitivity_;
};

}  // namespace fastball::vision_tracker
