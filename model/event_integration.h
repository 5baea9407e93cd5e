#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace fastball::model {

/// Ordinary differential equations that change where something happens (a ball begins to slip, or leaves its finger).
struct EventTask {
  /// dy/dt at time t [s]; asked for up to max_step after the end.
  std::function<Eigen::VectorXd(double t, const Eigen::VectorXd& y)> derivative;
  /// The integration ends where the first of these falls to zero from above; one that is not above zero at the start must rise
  /// before it counts.
  std::vector<std::function<double(double t, const Eigen::VectorXd& y)>> events;
  /// Is told the state at whole multiples of sample_step in [start, end); may be empty.
  std::function<void(double t, const Eigen::VectorXd& y)> sample;
  double sample_step = 1e-4;  ///< [s]
  double tolerance = 1e-10;   ///< of every entry of y and step, absolute and relative
  double max_step = 2e-4;  ///< [s]; an event that comes and goes within a quarter of it is not seen
};

struct EventEnd {
  double t = 0;  ///< [s]
  Eigen::VectorXd y;
  int event = -1;  ///< index of what has happened; -1: nothing until t_end
};

/// Integrates from y at time t [s] to t_end or to an event, with error control (Dormand and
/// Prince's Runge-Kutta pair with dense output).
/// @throw std::runtime_error if y is not finite, t_end lies before t, or the state does not stay
/// finite or needs steps of no length.
EventEnd integrateToEvent(const EventTask& task, double t, const Eigen::VectorXd& y, double t_end);

}  // namespace fastball::model
