#pragma once

#include <Eigen/Core>

#include "model/ball_flight.h"

namespace fastball::vision_tracker {

/// What a flight is determined by: position, velocity, drag k [1/m], lift S [1/s].
constexpr int kFlightParameters = 10;

/// Derivative of position and velocity with respect to (p0, v0, k, S).
using FlightSensitivity = Eigen::Matrix<double, 6, kFlightParameters>;

/// The ball `duration` [s] later: a = g - k |v| v + S x v. Without lift it is model::fly().
/// @param drag_per_metre k [1/m] @param lift S [1/s] @param gravity [m/s^2]
model::BallState flyLifted(const model::BallState& start,
                           double duration,
                           double drag_per_metre,
                           const Eigen::Vector3d& lift,
                           double gravity);

/// A flight a = g - k |v| v + S x v followed through time, together with its derivative with respect to the start, the drag and,
/// if `with_lift`, the lift (else those columns are zero). S is the lift of a ball whose spin does not change (Magnus), which
/// grows with the speed as in the common model of small spin.
class FlightPath {
 public:
  FlightPath(const model::BallState& start,
             double drag_per_metre,
             double gravity,
             const Eigen::Vector3d& lift = Eigen::Vector3d::Zero(),
             bool with_lift = false);
  /// Moves to `time` [s] after the start (earlier times too): Runge-Kutta 4, steps of at most 5 ms.
  void moveTo(double time);
  const model::BallState& state() const { return state_; }
  const FlightSensitivity& sensitivity() const { return sensitivity_; }

 private:
  template <int Columns>
  void step(double h);
  double drag_per_metre_, gravity_;
  Eigen::Vector3d lift_;
  bool with_lift_;
  double time_ = 0;
  model::BallState state_;
  FlightSensitivity sensitivity_;
};

}  // namespace fastball::vision_tracker
