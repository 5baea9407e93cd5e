#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/hand_parameters.h"

namespace fastball::hand_server {

/// [N], in the contact plane of finger A, thumb, finger B: along z of H (distal), and across it.
using TangentialForces = std::array<Eigen::Vector2d, model::kFingers>;

/// Feels by the tangential forces whether the fingers carry the ball along: what pulls it out between them, along z of H, only
/// friction can hold. A ball that gets less than its mass takes is slipping.
class SlipWatch {
 public:
  struct Slip {
    double carried = 0, needed = 0;  ///< [N], along z of H
  };

  /// Call once a tick. @param needed [N], mass times (acceleration of the hand less gravity) along z of H.
  /// @return once, when the ball has been slipping for 5 ms.
  std::optional<Slip> step(double needed, const TangentialForces& force) {
    double carried = 0;
    for (const Eigen::Vector2d& finger : force)
      carried += finger[0];
    const double missing = std::abs(needed - carried);
    ticks_ = missing > std::max(kLeast, kShare * std::abs(needed)) ? ticks_ + 1 : 0;
    if (said_ || ticks_ < kTicks)
      return {};
    said_ = true;
    return Slip{carried, needed};
  }

 private:
  // What a mass unknown by 15 %, the ball's weight and a swing between two ticks can feign stays below these.
  static constexpr double kLeast = 0.25;  // [N]
  static constexpr double kShare = 0.25;
  static constexpr int kTicks = 5;
  int ticks_ = 0;
  bool said_ = false;
};

}  // namespace fastball::hand_server
