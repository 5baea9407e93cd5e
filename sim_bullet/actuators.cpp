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

HandServo::HandServo(const model::HandParameters& hand, const FingerDelays& delays, double dt)
    : speed_max_(hand.joint_speed_max),
      lag_gain_(hand.actuator_lag > 0 ? 1 - std::exp(-dt / hand.actuator_lag) : 1) {
  for (int i = 0; i < model::kHandJoints; ++i)
    tau_max_[i] = isWrist(i) ? hand.wrist_torque_max : hand.finger_torque_max;
  for (int i = 0; i < model::kFingers; ++i)
    delay_steps_[i] = static_cast<std::size_t>(std::lround(delays[i] / dt));
  underway_.resize(*std::max_element(delay_steps_.begin(), delay_steps_.end()) + 1);
}

const HandVector& HandServo::step(const HandCommand& now,
                                  const HandVector& q,
                                  const HandVector& qd) {
  const HandCommand& command = arrived(now);
  HandVector tau = command.tau + command.kp.cwiseProduct(command.q - q) +
                   command.kd.cwiseProduct(command.qd - qd);
  tau = tau.cwiseMax(-tau_max_).cwiseMin(tau_max_);
  lagged_ += lag_gain_ * (tau - lagged_);
  applied_ = lagged_;
  for (int i = 0; i < model::kHandJoints; ++i)
    if (!isWrist(i))
      applied_[i] = withinSpeed(lagged_[i], qd[i], speed_max_);
  return applied_;
}

const HandCommand& HandServo::arrived(const HandCommand& command) {
  if (underway_.size() == 1)
    return command;
  if (!started_)  // as if it had always been the command
    std::fill(underway_.begin(), underway_.end(), command);
  started_ = true;
  newest_ = (newest_ + 1) % underway_.size();
  underway_[newest_] = command;
  arrived_ = command;
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const std::size_t size = underway_.size();
    const HandCommand& old = underway_[(newest_ + size - delay_steps_[finger]) % size];
    const auto [first, joints] = model::Hand::jointsOf(finger);
    arrived_.q.segment(first, joints) = old.q.segment(first, joints);
    arrived_.qd.segment(first, joints) = old.qd.segment(first, joints);
    arrived_.tau.segment(first, joints) = old.tau.segment(first, joints);
    arrived_.kp.segment(first, joints) = old.kp.segment(first, joints);
    arrived_.kd.segment(first, joints) = old.kd.segment(first, joints);
  }
  return arrived_;
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
