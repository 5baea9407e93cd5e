#pragma once

#include <algorithm>
#include <cstdint>

#include "model/hand.h"

namespace fastball::model {

/// All joints of the hand from one posture to another, smoothly: at rest at both ends, with two continuous derivatives.
class JointPath {
 public:
  JointPath() = default;
  /// @param start_utime [us], simulated; @param duration [s], positive.
  JointPath(const HandVector& from, const HandVector& to, int64_t start_utime, double duration)
      : from_(from), to_(to), start_utime_(start_utime), duration_(duration) {}

  struct Point {
    HandVector q, qd;  ///< [rad], [rad/s]
  };
  Point at(int64_t utime) const {
    const double s = progress(utime), s2 = s * s;
    const double rate = 30 * s2 * (1 - 2 * s + s2) / duration_;
    return {from_ + (to_ - from_) * (s2 * s * (10 - 15 * s + 6 * s2)), (to_ - from_) * rate};
  }
  bool done(int64_t utime) const { return progress(utime) >= 1; }

 private:
  double progress(int64_t utime) const {
    return std::clamp(static_cast<double>(utime - start_utime_) / (1e6 * duration_), 0.0, 1.0);
  }

  HandVector from_ = HandVector::Zero(), to_ = HandVector::Zero();
  int64_t start_utime_ = 0;
  double duration_ = 1;
};

}  // namespace fastball::model
