#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace fastball::sim_bullet {

/// What trembles in the arm's joint readings: per joint a critically damped second-order process about 20 Hz, as cables and
/// structure have it, so that its speed is a reading too. The same seed gives the same noise; no size, no noise.
class EncoderNoise {
 public:
  /// @param sd [rad], standard deviation of each joint's angle. @param dt [s], tick.
  EncoderNoise(double sd, double dt, int64_t seed);

  /// One tick on.
  void step();
  const Eigen::Vector4d& q() const { return q_; }    ///< [rad]
  const Eigen::Vector4d& qd() const { return qd_; }  ///< [rad/s]

 private:
  double drive_;  ///< [rad/s], standard deviation of a tick's push
  double dt_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  Eigen::Vector4d q_ = Eigen::Vector4d::Zero(), qd_ = Eigen::Vector4d::Zero();
};

}  // namespace fastball::sim_bullet
