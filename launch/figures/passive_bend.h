#pragma once

#include <vector>

#include "model/swing_model.h"

namespace fastball::launch {

/// A curve y(t).
struct Curve {
  std::vector<double> t, y;
};

/// How joint 2 moves without torque while joints 1 and 3 turn evenly.
struct BendMotion {
  double qd1 = 0, qd3 = 0;  ///< [rad/s]
  Curve q2;                 ///< [s], [rad]
};

/// Joint 2 from rest at q2_start [rad], q1 = q3 = 0 then, for `duration` [s] in steps of `step`
/// [s]; integrated with a step of its own to 1e-10 rad. @param qd1, qd3 [rad/s]
BendMotion passiveBend(const model::SwingModel& model,
                       double qd1,
                       double qd3,
                       double q2_start,
                       double duration,
                       double step);

/// An oscillation whose frequency may sway, in the mean from the first to the last time at which it
/// goes up through its mean.
struct Oscillation {
  double omega = 0;  ///< [rad/s]; 0: it goes up through it less than twice
  double mean = 0;   ///< [rad]
};
Oscillation oscillation(const Curve& curve);

/// y = slope x + offset by least squares.
struct Line {
  double slope = 0, offset = 0;
};
/// @throw std::invalid_argument unless there are two different x.
Line fitLine(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace fastball::launch
