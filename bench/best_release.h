#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bench/throw_limits.h"

namespace fastball::bench {

/// A pose and joint speeds from which the ball flies where it shall.
struct BestRelease {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();   ///< [rad]
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();  ///< [rad/s]
  double flight_time = 0;                        ///< [s]
  double speed = 0;                              ///< [m/s], of the ball
};

/// What makes one release better than another.
enum class Merit {
  kFastest,  ///< the ball's speed
  kEasiest,  ///< small joint speeds: the sum of the squares of their shares of the limits
};

/// The best releases within ranges, speed limits and clearances, torque left aside: no throw is
/// faster than the fastest of them. Local optima from random poses, each once, the best first.
std::vector<BestRelease> bestReleases(const FreeThrow& task, Merit merit, int starts, int64_t seed);

}  // namespace fastball::bench
