#include "planner/swing_limits.h"

#include <algorithm>
#include <cmath>

#include "model/arm_derivatives.h"

namespace fastball::planner {
namespace {

// [rad] of the joint ranges, for what the samples of the finished motion lose.
constexpr double kReserve = 1e-4;
// [m], world: the column ends a little above the shoulder.
constexpr double kColumnTop = 0.1;

double signOf(double x) {
  return x < 0 ? -1 : 1;
}

}  // namespace

Eigen::Matrix4d driveShares(const Eigen::Vector4d& limit, bool differential) {
  Eigen::Matrix4d shares = limit.cwiseInverse().asDiagonal();
  if (differential) {
    shares(1, 2) = shares(2, 2);
    shares(2, 1) = shares(1, 1);
    shares(2, 2) = -shares(2, 2);
  }
  return shares;
}

SwingLimits::SwingLimits(const SwingTask& task, int elbow_sign)
    : arm_(*task.arm), settings_(task.settings), elbow_sign_(elbow_sign) {
  const model::ArmParameters& limits = arm_.parameters();
  const double margin = limits.position_margin + kReserve;
  q_low_ = limits.q_min.array() + margin;
  q_high_ = limits.q_max.array() - margin;
  speed_share_ = driveShares(task.limit_factor * limits.qd_max, limits.differential);
  torque_share_ = driveShares(task.limit_factor * limits.tau_max, limits.differential);
}

double SwingLimits::range(int joint, double q) const {
  const double low = q_low_[joint], high = q_high_[joint];
  return std::abs(2 * q - low - high) / (high - low) - 1;
}

Eigen::Vector4d SwingLimits::torque(const model::ArmMotion& motion) const {
  return arm_.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm_.frictionTorque(motion.qd);
}

double SwingLimits::columnDistance(const Eigen::Vector3d& p_WBall) const {
  const double above = std::max(0.0, p_WBall.z() - kColumnTop);
  return std::sqrt(p_WBall.head<2>().squaredNorm() + above * above);
}

SwingLimits::Values SwingLimits::at(const model::ArmMotion& motion,
                                    const Eigen::Vector3d& p_TBall) const {
  Values values;
  for (int j = 0; j < model::kArmJoints; ++j)
    values[kRange1 + j] = range(j, motion.q[j]);
  values.segment<4>(kDriveSpeed1) = (speed_share_ * motion.qd).array().abs() - 1;
  values.segment<4>(kDriveTorque1) = (torque_share_ * torque(motion)).array().abs() - 1;
  const Eigen::Vector3d p_WBall = arm_.p_WPoint(motion.q, p_TBall);
  values[kElbow] = settings_.elbow_margin - elbow_sign_ * motion.q[3];
  values[kColumn] = settings_.body_clearance - columnDistance(p_WBall);
  values[kFloor] = settings_.lowest_ball - p_WBall.z();
  return values;
}

double SwingLimits::at(SwingLimit limit,
                       const model::ArmMotion& motion,
                       const Eigen::Vector3d& p_TBall) const {
  if (limit <= kRange4)
    return range(limit - kRange1, motion.q[limit - kRange1]);
  if (limit <= kDriveSpeed4)
    return std::abs(speed_share_.row(limit - kDriveSpeed1).dot(motion.qd)) - 1;
  if (limit <= kDriveTorque4)
    return std::abs(torque_share_.row(limit - kDriveTorque1).dot(torque(motion))) - 1;
  if (limit == kElbow)
    return settings_.elbow_margin - elbow_sign_ * motion.q[3];
  const Eigen::Vector3d p_WBall = arm_.p_WPoint(motion.q, p_TBall);
  return limit == kColumn ? settings_.body_clearance - columnDistance(p_WBall)
                          : settings_.lowest_ball - p_WBall.z();
}

SwingLimits::Gradient SwingLimits::gradient(SwingLimit limit,
                                            const model::ArmMotion& motion,
                                            const HeldBall& held) const {
  Gradient g;
  if (limit <= kRange4) {
    const int j = limit - kRange1;
    const double low = q_low_[j], high = q_high_[j];
    g.motion.q[j] = signOf(2 * motion.q[j] - low - high) * 2 / (high - low);
  } else if (limit <= kDriveSpeed4) {
    const auto share = speed_share_.row(limit - kDriveSpeed1);
    g.motion.qd = signOf(share.dot(motion.qd)) * share.transpose();
  } else if (limit <= kDriveTorque4) {
    const model::TorqueDerivatives d =
        arm_.inverseDynamicsDerivatives(motion.q, motion.qd, motion.qdd);
    Eigen::Vector4d share = torque_share_.row(limit - kDriveTorque1).transpose();
    share *= signOf(share.dot(d.tau + arm_.frictionTorque(motion.qd)));
    g.motion.q = d.dtau_dq.transpose() * share;
    g.motion.qd =
        d.dtau_dqd.transpose() * share + arm_.frictionSlope(motion.qd).cwiseProduct(share);
    g.motion.qdd = d.dtau_dqdd.transpose() * share;
  } else if (limit == kElbow) {
    g.motion.q[3] = -elbow_sign_;
  } else {
    const Eigen::Isometry3d X_WT = arm_.X_WT(motion.q);
    const Eigen::Vector3d p = X_WT * held.p_TBall;
    Eigen::Vector3d by_p = -Eigen::Vector3d::UnitZ();
    if (limit == kColumn) {
      const Eigen::Vector3d away(p.x(), p.y(), std::max(0.0, p.z() - kColumnTop));
      by_p = -away / away.norm();
    }
    g.motion.q = arm_.pointJacobian(motion.q, held.p_TBall).transpose() * by_p;
    g.roll = by_p.dot(X_WT.linear() * held.p_by_roll);
    g.flexion = by_p.dot(X_WT.linear() * held.p_by_flexion);
  }
  return g;
}

const char* SwingLimits::name(SwingLimit limit) {
  static constexpr const char* kNames[kSwingLimits] = {
      "the range of joint 1",
      "the range of joint 2",
      "the range of joint 3",
      "the range of joint 4",
      "the speed limit of joint 1",
      "the speed limit of joints 2 and 3",
      "the speed limit of joints 2 and 3",
      "the speed limit of joint 4",
      "the torque limit of joint 1",
      "the torque limit of joints 2 and 3",
      "the torque limit of joints 2 and 3",
      "the torque limit of joint 4",
      "the distance of the elbow from its straight pose",
      "the clearance from the column",
      "the clearance from the floor"};
  return kNames[limit];
}

}  // namespace fastball::planner
