#pragma once

#include "planner/swing_curve.h"

namespace fastball::planner {

/// Coordinates in which the problem is less curved than in the parameters of Eq. (12): instead of each base function's
/// amplitude its peak speed, amplitude times omega, instead of its c its value at the release. A change of omega then changes
/// neither, while in the parameters the throws at a speed limit lie on a hyperbola. All other variables are the same.
SwingVector coordinatesOf(const SwingVector& x);

/// The parameters back from their coordinates.
SwingVector parametersOf(const SwingVector& y);

/// Turns derivatives by the parameters at x into derivatives by the coordinates.
class CoordinateGradient {
 public:
  explicit CoordinateGradient(const SwingVector& x);
  SwingVector operator()(const SwingVector& by_parameters) const;

 private:
  struct Block {
    double amplitude_by_speed, amplitude_by_omega;
    double c_by_speed, c_by_omega, c_by_phase;
  };
  std::array<Block, 4> blocks_;
};

}  // namespace fastball::planner
