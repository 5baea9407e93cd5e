#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "hand_server/ball_watch.h"
#include "hand_server/slip_watch.h"
#include "model/hand.h"

namespace fastball::hand_server {

/// [s]: a force is the mean over a tick, so it is that of half a tick before its state.
inline constexpr double kHalfTick = 0.5e-3;

/// One measured state of the hand.
struct HandSample {
  int64_t utime = 0;  ///< [us], simulated
  int64_t scene_id = 0;
  int64_t tick = 0;                                  ///< since the start of the scene
  model::HandVector q = model::HandVector::Zero();   ///< [rad]
  model::HandVector qd = model::HandVector::Zero();  ///< [rad/s]
  FingerForces force{};                              ///< [N], normal, mean over the tick before
  TangentialForces tangential{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                              Eigen::Vector2d::Zero()};  ///< [N], mean over the tick before
  model::HandVector tau = model::HandVector::Zero();     ///< [N m], of the drives
};

}  // namespace fastball::hand_server
