#pragma once

#include <cstdint>

namespace fastball::model {

/// Lets the thumb go (section 3.1): pushed open with all its torque and no stiffness, so that it leaves the ball abruptly; fast
/// enough or near its end it is guided, and then held open.
class ThumbOpening {
 public:
  /// How the thumb opens; config/experiment.yaml has the reason of each number.
  struct Settings {
    double open_angle = 0;    ///< [rad], proximal joint of the open thumb
    double speed = 0;         ///< [rad/s], at which the opening thumb is pushed no further
    double deceleration = 1;  ///< [rad/s^2], at the end of its way
  };

  ThumbOpening() = default;
  /// @param torque_max [N m] of the drive.
  ThumbOpening(const Settings& settings, double torque_max)
      : open_angle_(settings.open_angle),
        switch_speed_(settings.speed),
        deceleration_(settings.deceleration),
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

}  // namespace fastball::model
