#include "launch/report/joint_shares.h"

#include <algorithm>
#include <cmath>

namespace fastball::launch {
namespace {

JointShares sharesOf(const double* values, const Eigen::Vector4d& limits, bool differential) {
  JointShares shares{};
  for (int joint = 0; joint < model::kArmJoints; ++joint)
    shares[static_cast<std::size_t>(joint)] = values[joint] / limits[joint];
  if (differential)
    shares.back() = std::abs(shares[1]) + std::abs(shares[2]);
  return shares;
}

void raise(JointShares& peaks, const JointShares& shares) {
  for (std::size_t i = 0; i < peaks.size(); ++i)
    peaks[i] = std::max(peaks[i], std::abs(shares[i]));
}

}  // namespace

JointShares speedShares(const model::ArmParameters& arm, const arm_state_t& state) {
  return sharesOf(state.qd, arm.qd_max, arm.differential);
}

JointShares torqueShares(const model::ArmParameters& arm, const arm_state_t& state) {
  return sharesOf(state.tau, arm.tau_max, arm.differential);
}

JointPeaks peaksOf(const ThrowRecord& record, const model::ArmParameters& arm) {
  JointPeaks peaks;
  for (const arm_state_t& state : record.arm) {
    raise(peaks.speed, speedShares(arm, state));
    raise(peaks.torque, torqueShares(arm, state));
  }
  return peaks;
}

}  // namespace fastball::launch
