#include "sim_bullet/actuators.h"

#include <algorithm>
#include <cmath>

namespace fastball::sim_bullet {
namespace {

using model::HandVector;

/// The drive's torque fades to nothing over this share of its greatest speed, so that it does not switch at it.
constexpr double kFadeShare = 0.05;

bool isSpread(int joint) {
  return joint == model::kSpreadA || joint == model::kSpreadB;
}

bool isWrist(int joint) {
  return joint == model::kWristRoll || joint == model::kWristFlexion;
}

/// `tau` as far as a drive that turns at `qd` can give it: braking in full, driving up to speed_max.
double withinSpeed(double tau, double qd, double speed_max) {
  if (tau * qd <= 0)
    return tau;
  return tau * std::clamp((1 - std::abs(qd) / speed_max) / kFadeShare, 0.0, 1.0);
}

}  // namespace

HandServo::HandServo(const model::HandParameters& hand, double thumb_delay, double dt)
    : speed_max_(hand.joint_speed_max),
      lag_gain_(hand.actuator_lag > 0 ? 1 - std::exp(-dt / hand.actuator_lag) : 1),
      delay_line_(static_cast<std::size_t>(std::lround(thumb_delay / dt)),
                  Eigen::Vector2d::Zero()) {
  for (int i = 0; i < model::kHandJoints; ++i)
    tau_max_[i] = isWrist(i) ? hand.wrist_torque_max : hand.finger_torque_max;
}

const HandVector& HandServo::step(const HandCommand& command,
                                  const HandVector& q,
                                  const HandVector& qd) {
  HandVector tau = command.tau + command.kp.cwiseProduct(command.q - q) +
                   command.kd.cwiseProduct(command.qd - qd);
  tau = tau.cwiseMax(-tau_max_).cwiseMin(tau_max_);
  delayThumb(&tau);
  lagged_ += lag_gain_ * (tau - lagged_);
  applied_ = lagged_;
  for (int i = 0; i < model::kHandJoints; ++i)
    if (!isWrist(i))
      applied_[i] = withinSpeed(lagged_[i], qd[i], speed_max_);
  return applied_;
}

void HandServo::delayThumb(HandVector* tau) {
  if (delay_line_.empty())
    return;
  Eigen::Vector2d& slot = delay_line_[oldest_];
  const Eigen::Vector2d arrived = slot;
  slot = Eigen::Vector2d((*tau)[model::kProximalThumb], (*tau)[model::kDistalThumb]);
  (*tau)[model::kProximalThumb] = arrived[0];
  (*tau)[model::kDistalThumb] = arrived[1];
  oldest_ = (oldest_ + 1) % delay_line_.size();
}

double stopTorque(const StopSettings& stop, double low, double high, double q, double qd) {
  if (q > high)
    return std::min(0.0, -stop.stiffness * (q - high) - stop.damping * qd);
  if (q < low)
    return std::max(0.0, -stop.stiffness * (q - low) - stop.damping * qd);
  return 0;
}

JointStops::JointStops(const model::ArmParameters& arm,
                       const model::HandParameters& hand,
                       const SimulationSettings& settings)
    : arm_(settings.arm_stop),
      wrist_(settings.wrist_stop),
      finger_(settings.finger_stop),
      q_min_(arm.q_min),
      q_max_(arm.q_max) {
  for (int i = 0; i < model::kHandJoints; ++i) {
    limit_[i] = isWrist(i)    ? hand.wrist_limit
                : isSpread(i) ? settings.spread_limit
                              : settings.flexion_limit;
  }
}

JointVectors JointStops::torque(const JointVectors& q, const JointVectors& qd) const {
  JointVectors tau;
  for (int i = 0; i < model::kArmJoints; ++i)
    tau.arm[i] = stopTorque(arm_, q_min_[i], q_max_[i], q.arm[i], qd.arm[i]);
  for (int i = 0; i < model::kHandJoints; ++i) {
    const StopSettings& stop = isWrist(i) ? wrist_ : finger_;
    tau.hand[i] = stopTorque(stop, -limit_[i], limit_[i], q.hand[i], qd.hand[i]);
  }
  return tau;
}

}  // namespace fastball::sim_bullet
