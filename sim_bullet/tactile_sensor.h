#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "model/hand_parameters.h"
#include "sim_bullet/ball_contact.h"
#include "sim_bullet/config.h"

namespace fastball::sim_bullet {

/// Of the three fingers: A, thumb, B.
using FingertipForces = std::array<FingerForce, model::kFingers>;

/// The force sensors in the fingertips, read once a tick: the mean over a tick that ended `delay` ago, with white noise on each
/// component, in steps of the resolution. A normal force reads 0 or positive. The same seed gives the same noise. Only the
/// constructor allocates.
class TactileSensor {
 public:
  /// @param dt physics step [s]; the delay is rounded to whole steps.
  TactileSensor(const TactileSettings& settings, double dt, int64_t seed);

  /// Takes the forces of one physics step.
  void step(const FingertipForces& force);
  /// What the sensors say of the steps since the last reading.
  FingertipForces read();

 private:
  double reading(double mean);

  double noise_, resolution_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::vector<FingertipForces> underway_;  ///< a ring of the forces of the last steps
  std::size_t next_ = 0;
  FingertipForces sum_;
  int steps_ = 0;
};

}  // namespace fastball::sim_bullet
