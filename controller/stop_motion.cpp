#include "controller/stop_motion.h"

#include <algorithm>
#include <limits>

namespace fastball::controller {
namespace {

constexpr double kTick = 1e-3;
/// [rad/s^2], of the vector of joint speeds: more than the drives can do in any pose.
constexpr double kDecelerationMax = 300;
constexpr int kCandidates = 100;

}  // namespace

void StopMotion::begin(const Eigen::Vector4d& q, const Eigen::Vector4d& qd) {
  motion_.q = q;
  motion_.qd = qd;
  chooseDeceleration();
}

void StopMotion::advance(int ticks) {
  for (int i = 0; i < ticks && !atRest(); ++i) {
    motion_.q += motion_.qd * kTick + motion_.qdd * (0.5 * kTick * kTick);
    for (int joint = 0; joint < model::kArmJoints; ++joint) {
      const double next = motion_.qd[joint] + motion_.qdd[joint] * kTick;
      // What the last tick of braking leaves is rounding.
      motion_.qd[joint] = next * motion_.qd[joint] > 1e-12 ? next : 0.0;
    }
    chooseDeceleration();
  }
}

/// Constant deceleration of each joint [rad/s^2] with which it just does not reach its stop.
Eigen::Vector4d StopMotion::decelerationAtStops() const {
  const model::ArmParameters& limits = arm_.parameters();
  Eigen::Vector4d result;
  for (int i = 0; i < model::kArmJoints; ++i) {
    const double speed = motion_.qd[i];
    const double way = speed > 0 ? limits.q_max[i] - motion_.q[i] : motion_.q[i] - limits.q_min[i];
    result[i] = speed * speed / (2 * std::max(way - limits.position_margin, 1e-6));
  }
  return result;
}

void StopMotion::chooseDeceleration() {
  motion_.qdd.setZero();
  const double speed = motion_.qd.norm();
  if (speed == 0) {
    return;
  }
  const Eigen::Matrix4d M = arm_.massMatrix(motion_.q);
  const Eigen::Vector4d bias =
      arm_.inverseDynamics(motion_.q, motion_.qd, Eigen::Vector4d::Zero()) +
      arm_.frictionTorque(motion_.qd);
  const Eigen::Vector4d magnitude = motion_.qd.cwiseAbs();
  // No joint may be asked for more than its drive can do, nor turned back within the tick.
  const Eigen::Vector4d at_stops = decelerationAtStops().cwiseMin(
      torque_share_ * arm_.parameters().tau_max.cwiseQuotient(M.diagonal()));

  double least_ratio = std::numeric_limits<double>::infinity();
  for (int i = kCandidates; i > 0; --i) {
    const Eigen::Vector4d amount = (magnitude * (kDecelerationMax * i / kCandidates / speed))
                                       .cwiseMax(at_stops)
                                       .cwiseMin(magnitude / kTick);
    const Eigen::Vector4d qdd = -amount.cwiseProduct(motion_.qd.cwiseSign());
    const double ratio = arm_.torqueRatio(bias + M * qdd);
    if (ratio < least_ratio) {
      least_ratio = ratio;
      motion_.qdd = qdd;
    }
    if (ratio <= torque_share_) {
      return;
    }
  }
}

}  // namespace fastball::controller
