#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/arm.h"
#include "model/hand.h"
#include "sim_bullet/arm_hand.h"
#include "sim_bullet/config.h"

namespace fastball::sim_bullet {

/// What HAND_COMMAND asks of the hand's own servo, one entry a joint.
struct HandCommand {
  model::HandVector q = model::HandVector::Zero();    ///< [rad]
  model::HandVector qd = model::HandVector::Zero();   ///< [rad/s]
  model::HandVector tau = model::HandVector::Zero();  ///< [N m]
  model::HandVector kp = model::HandVector::Zero();   ///< [N m/rad]
  model::HandVector kd = model::HandVector::Zero();   ///< [N m s/rad]
};

/// The hand's drives: a servo faster than the control tick, its torque limits, the first-order lag from command to torque, and
/// the speed above which a finger's drive can push no further.
class HandServo {
 public:
  /// @param thumb_delay extra dead time [s] of the thumb's torque.
  /// @param dt physics step [s].
  HandServo(const model::HandParameters& hand, double thumb_delay, double dt);

  /// Torques [N m] for the coming step.
  const model::HandVector& step(const HandCommand& command,
                                const model::HandVector& q,
                                const model::HandVector& qd);

 private:
  void delayThumb(model::HandVector* tau);

  model::HandVector tau_max_;
  double speed_max_;
  double lag_gain_;  ///< share of the way to the commanded torque that the drive goes in a step
  model::HandVector lagged_ = model::HandVector::Zero();
  model::HandVector applied_ = model::HandVector::Zero();
  std::vector<Eigen::Vector2d> delay_line_;  ///< thumb torques on their way, a ring
  std::size_t oldest_ = 0;
};

/// Torque [N m] of a joint's stops: none between them; past one a spring and a damper, which push back but never hold.
double stopTorque(const StopSettings& stop, double low, double high, double q, double qd);

/// Stops of all joints.
class JointStops {
 public:
  JointStops(const model::ArmParameters& arm,
             const model::HandParameters& hand,
             const SimulationSettings& settings);
  JointVectors torque(const JointVectors& q, const JointVectors& qd) const;

 private:
  StopSettings arm_, wrist_, finger_;
  Eigen::Vector4d q_min_, q_max_;
  model::HandVector limit_;  ///< of the hand's joints, both ways
};

}  // namespace fastball::sim_bullet
