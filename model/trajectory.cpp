#include "model/trajectory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace fastball::model {

SampledTrajectory::SampledTrajectory(double dt, std::vector<ArmMotion> samples)
    : dt_(dt), samples_(std::move(samples)) {
  if (!(std::isfinite(dt) && dt > 0)) {
    throw std::invalid_argument("a trajectory needs a positive sample time, not " +
                                std::to_string(dt) + " s");
  }
  if (samples_.size() < 2) {
    throw std::invalid_argument("a trajectory needs at least 2 samples, not " +
                                std::to_string(samples_.size()));
  }
}

double SampledTrajectory::duration() const {
  return samples_.empty() ? 0.0 : dt_ * static_cast<double>(samples_.size() - 1);
}

ArmMotion SampledTrajectory::at(double t) const {
  if (samples_.empty()) {
    return {};
  }
  if (!(t >= 0)) {
    return {samples_.front().q};
  }
  const double position = t / dt_;
  const auto last = static_cast<double>(samples_.size() - 1);
  if (position > last) {
    return {samples_.back().q};
  }
  const auto index =
      static_cast<std::size_t>(std::min(std::floor(position), last - 1));  // closed at the end
  const ArmMotion& from = samples_[index];
  const ArmMotion& to = samples_[index + 1];

  // Quintic in s = 0..1: c0 + c1 s + ... + c5 s^5, with derivatives with respect to s at both ends.
  const double s = position - static_cast<double>(index);
  const Eigen::Vector4d c1 = from.qd * dt_;
  const Eigen::Vector4d c2 = from.qdd * (0.5 * dt_ * dt_);
  const Eigen::Vector4d gap = to.q - from.q - c1 - c2;
  const Eigen::Vector4d gap_d = to.qd * dt_ - c1 - 2 * c2;
  const Eigen::Vector4d gap_dd = to.qdd * (dt_ * dt_) - 2 * c2;
  const Eigen::Vector4d c3 = 10 * gap - 4 * gap_d + 0.5 * gap_dd;
  const Eigen::Vector4d c4 = -15 * gap + 7 * gap_d - gap_dd;
  const Eigen::Vector4d c5 = 6 * gap - 3 * gap_d + 0.5 * gap_dd;
  ArmMotion motion;
  motion.q = from.q + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
  motion.qd = (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / dt_;
  motion.qdd = (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (dt_ * dt_);
  return motion;
}

bool operator==(const SampledTrajectory& a, const SampledTrajectory& b) {
  return a.dt() == b.dt() &&
         std::equal(a.samples().begin(), a.samples().end(), b.samples().begin(), b.samples().end(),
                    [](const ArmMotion& x, const ArmMotion& y) {
                      return x.q == y.q && x.qd == y.qd && x.qdd == y.qdd;
                    });
}

}  // namespace fastball::model
