#pragma once

#include <cstdint>

#include "hand_server/config.h"

namespace fastball::hand_server {

/// Lets the thumb go (section 3.1): pushed open with all its torque and no stiffness, so that it leaves the ball abruptly; fast
/// enough or near its end it is guided, and then held open.
class ThumbOpening {
 public:
  ThumbOpening() = default;
  /// @param torque_max [N m] of the drive; @param now [us], the moment of release.
  ThumbOpening(const HandServerConfig& config, double torque_max)
      : open_angle_(config.thumb_open_angle),
        switch_speed_(config.thumb_speed),
        deceleration_(config.thumb_deceleration),
        torque_max_(torque_max) {}

  /// What the proximal joint of the thumb shall do.
  struct Drive {
    double q = 0;         ///< [rad]
    double qd = 0;        ///< [rad/s]
    double tau = 0;       ///< [N m], feed-forward
    bool guided = false;  ///< position and speed are to be followed; else only the torque counts
  };
  /// @param utime [us]; @param q [rad], qd [rad/s]: measured. Call once a tick.
  Drive step(int64_t utime, double q, double qd);

 private:
  Drive guide(double t) const;

  double open_angle_ = 0, switch_speed_ = 0, deceleration_ = 1, torque_max_ = 0;
  bool guided_ = false;
  int64_t guide_utime_ = 0;
  double q_guide_ = 0, speed_ = 0;  ///< where and how fast the guided part begins
};

}  // namespace fastball::hand_server
