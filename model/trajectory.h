#pragma once

#include <Eigen/Core>
#include <vector>

namespace fastball::model {

/// Joint positions, velocities and accelerations at one time.
struct ArmMotion {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();    ///< [rad]
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();   ///< [rad/s]
  Eigen::Vector4d qdd = Eigen::Vector4d::Zero();  ///< [rad/s^2]
};

/// A motion sampled at even times, as SWING_PLAN carries it. Between samples: the quintic Hermite
/// polynomial through both neighbours' (q, qd, qdd). Before the first and after the last sample the
/// arm rests there.
class SampledTrajectory {
 public:
  SampledTrajectory() = default;
  /// @throw std::invalid_argument unless dt > 0 and there are at least two samples.
  SampledTrajectory(double dt, std::vector<ArmMotion> samples);
  double duration() const;  ///< [s]
  /// Does not allocate or throw; t [s] may lie outside. Without samples all zero.
  ArmMotion at(double t) const;
  double dt() const { return dt_; }  ///< [s]
  const std::vector<ArmMotion>& samples() const { return samples_; }

 private:
  double dt_ = 0;
  std::vector<ArmMotion> samples_;
};
/// The same samples to the last digit.
bool operator==(const SampledTrajectory& a, const SampledTrajectory& b);

}  // namespace fastball::model
