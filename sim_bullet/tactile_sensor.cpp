#include "sim_bullet/tactile_sensor.h"

#include <algorithm>
#include <cmath>

namespace fastball::sim_bullet {
namespace {

/// The sensors' noise must not follow the other random numbers of a scene, which begin with the same seed.
constexpr uint64_t kStream = 0x74616374696c65;

}  // namespace

TactileSensor::TactileSensor(const TactileSettings& settings, double dt, int64_t seed)
    : noise_(settings.noise),
      resolution_(settings.resolution),
      engine_(static_cast<uint64_t>(seed) ^ kStream),
      underway_(static_cast<std::size_t>(std::lround(settings.delay / dt)) + 1) {}

void TactileSensor::step(const FingertipForces& force) {
  underway_[next_] = force;
  next_ = (next_ + 1) % underway_.size();
  const FingertipForces& arrived = underway_[next_];  // the oldest
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    sum_[i].normal += arrived[i].normal;
    sum_[i].tangential += arrived[i].tangential;
  }
  ++steps_;
}

FingertipForces TactileSensor::read() {
  FingertipForces felt;
  const double share = steps_ > 0 ? 1.0 / steps_ : 0;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    felt[i].normal = std::max(0.0, reading(share * sum_[i].normal));
    for (int axis = 0; axis < 2; ++axis)
      felt[i].tangential[axis] = reading(share * sum_[i].tangential[axis]);
  }
  sum_ = {};
  steps_ = 0;
  return felt;
}

double TactileSensor::reading(double mean) {
  const double noisy = mean + noise_ * normal_(engine_);
  return resolution_ > 0 ? resolution_ * std::round(noisy / resolution_) : noisy;
}

}  // namespace fastball::sim_bullet
