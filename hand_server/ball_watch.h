#pragma once

#include <cstdint>
#include <optional>

#include "model/release_motion.h"

namespace fastball::hand_server {

using model::FingerForces;

/// Feels by the finger forces when the ball leaves the hand, and whether it touches it again. A force is the mean over the tick before its state.
class BallWatch {
 public:
  BallWatch() = default;
  /// @param touch_force [N], less counts as no touch; @param quiet_time [s] without touch: the ball has left.
  BallWatch(double touch_force, double quiet_time)
      : touch_force_(touch_force), quiet_us_(static_cast<int64_t>(quiet_time * 1e6)) {}

  struct Departure {
    int64_t utime = 0;  ///< [us], of the last state with a touch
    FingerForces force{};
  };
  /// Call once a tick. Once, when a ball that was held has not been touched for the quiet time, says since when.
  std::optional<Departure> step(int64_t utime, const FingerForces& force) {
    const bool touch =
        force[0] >= touch_force_ || force[1] >= touch_force_ || force[2] >= touch_force_;
    if (touch && !departed_) {
      last_ = {utime, force};
      touched_ = true;
    }
    if (!touched_ || departed_ || utime - last_.utime < quiet_us_) {
      return {};
    }
    departed_ = true;
    return last_;
  }
  bool departed() const { return departed_; }
  /// Once, when a finger feels the ball after it has departed: which. Call after step().
  std::optional<model::Finger> touchedAgain(const FingerForces& force) {
    if (!departed_ || touched_again_)
      return {};
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      if (force[finger] >= touch_force_) {
        touched_again_ = true;
        return finger;
      }
    }
    return {};
  }
  const Departure& lastTouch() const { return last_; }

 private:
  double touch_force_ = 0;
  int64_t quiet_us_ = 0;
  bool touched_ = false;
  bool departed_ = false, touched_again_ = false;
  Departure last_;
};

}  // namespace fastball::hand_server
