#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/arm.h"
#include "model/hand.h"
#include "model/joint_targets.h"
#include "sim_bullet/arm_hand.h"
#include "sim_bullet/config.h"

namespace fastball::sim_bullet {

/// What HAND_COMMAND asks of the hand's own servo.
using HandCommand = model::JointTargets;

/// Dead times [s] from a command to the servos of finger A, thumb and finger B.
using FingerDelays = std::array<double, model::kFingers>;

/// The hand's drives: the dead time until a command arrives, a servo faster than the control tick, its torque limits, the
/// first-order lag from command to torque, and the speed above which a finger's drive can push no further.
class HandServo {
 public:
  /// @param delays of the fingers' commands; the wrist's arrive at once. The servo itself is not delayed.
  /// @param dt physics step [s].
  HandServo(const model::HandParameters& hand, const FingerDelays& delays, double dt);

  /// Torques [N m] for the coming step; q [rad], qd [rad/s] as they are.
  const model::HandVector& step(const HandCommand& command,
                                const model::HandVector& q,
                                const model::HandVector& qd);

 private:
  const HandCommand& arrived(const HandCommand& command);

  model::HandVector tau_max_;
  double speed_max_;
  double lag_gain_;  ///< share of the way to the commanded torque that the drive goes in a step
  model::HandVector lagged_ = model::HandVector::Zero();
  model::HandVector applied_ = model::HandVector::Zero();
  std::array<std::size_t, model::kFingers> delay_steps_{};
  std::vector<HandCommand> underway_;  ///< a ring of the commands of the last steps
  std::size_t newest_ = 0;
  bool started_ = false;
  HandCommand arrived_;
};

/// Torque [N m] of a joint's stops: none between them; past one a spring and a damper, which push back but never hold.
double stopTorque(const StopSettings& stop, double low, double high, double q, double qd);

/// Stops of all joints.
class JointStops {
 public:
  JointStops(const model::ArmParameters& arm,
             const model::HandParameters& hand,
             const SimulationSettings& settings);
  /// [N m]; q [rad], qd [rad/s].
  JointVectors torque(const JointVectors& q, const JointVectors& qd) const;

 private:
  StopSettings arm_, wrist_, finger_;
  Eigen::Vector4d q_min_, q_max_;
  model::HandVector limit_;  ///< of the hand's joints, both ways
};

}  // namespace fastball::sim_bullet
