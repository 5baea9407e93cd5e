#pragma once

#include "model/arm.h"
#include "model/trajectory.h"

namespace fastball::controller {

/// What is added to Kp dq + Kd dqd.
enum class Law {
  kFeedForward,  ///< inverse dynamics and friction of the desired motion
  kGravityPd     ///< gravity at the desired position only, Eq. (26)
};

/// Joint torques that make the arm follow a desired motion. Fixed size: nothing allocates or throws.
class ControlLaw {
 public:
  /// @param kp [N m/rad] and kd [N m s/rad], one for each joint.
  ControlLaw(const model::Arm& arm, const Eigen::Vector4d& kp, const Eigen::Vector4d& kd)
      : arm_(arm), kp_(kp), kd_(kd) {}

  struct Torque {
    Eigen::Vector4d tau = Eigen::Vector4d::Zero();  ///< [N m], inside the limits of the arm
    bool clipped = false;                           ///< the limits have changed it
  };
  /// @param q, qd measured position [rad] and speed [rad/s].
  Torque torque(Law law,
                const model::ArmMotion& desired,
                const Eigen::Vector4d& q,
                const Eigen::Vector4d& qd) const;

 private:
  model::Arm arm_;
  Eigen::Vector4d kp_, kd_;
};

}  // namespace fastball::controller
