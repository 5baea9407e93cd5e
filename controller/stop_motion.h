#pragma once

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::controller {

/// Brings the arm to rest from any speed and holds it there: straight on along the velocity it has, each tick with the largest
/// deceleration that a share of the torque limits allows. A joint that would run into its stop that way brakes harder than
/// the others. Fixed size: nothing allocates or throws.
class StopMotion {
 public:
  /// @param torque_share of the torque limits, in (0, 1]; the rest is left to the feedback.
  StopMotion(const model::Arm& arm, double torque_share) : arm_(arm), torque_share_(torque_share) {}

  /// Starts at q [rad] with qd [rad/s]. qd = 0 holds q.
  void begin(const Eigen::Vector4d& q, const Eigen::Vector4d& qd);
  /// Moves on by `ticks` milliseconds.
  void advance(int ticks);
  /// Desired motion now; its acceleration holds until the next tick.
  const model::ArmMotion& motion() const { return motion_; }
  bool atRest() const { return motion_.qd.isZero(0); }

 private:
  void chooseDeceleration();
  Eigen::Vector4d decelerationAtStops() const;

  model::Arm arm_;
  double torque_share_;
  model::ArmMotion motion_;
};

}  // namespace fastball::controller
