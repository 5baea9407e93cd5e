#include "sim_bullet/encoder_noise.h"

#include <cmath>

namespace fastball::sim_bullet {
namespace {

constexpr double kFrequency = 2 * 3.14159265358979323846 * 20;  // [rad/s]
/// Begins as after so many ticks: by then the noise has its size.
constexpr int kSettleTicks = 100;
/// The noise must not follow the other random numbers of a scene, which begin with the same seed.
constexpr uint64_t kStream = 0x656e636f64657273;

}  // namespace

// x'' + 2 w x' + w^2 x = white noise of intensity S has the variance S / (4 w^3).
EncoderNoise::EncoderNoise(double sd, double dt, int64_t seed)
    : drive_(sd * std::sqrt(4 * std::pow(kFrequency, 3) * dt)),
      dt_(dt),
      engine_(static_cast<uint64_t>(seed) ^ kStream) {
  for (int i = 0; i < kSettleTicks; ++i)
    step();
}

void EncoderNoise::step() {
  if (drive_ == 0)
    return;
  for (int i = 0; i < q_.size(); ++i) {
    const double force = -2 * kFrequency * qd_[i] - kFrequency * kFrequency * q_[i];
    qd_[i] += force * dt_ + drive_ * normal_(engine_);
    q_[i] += qd_[i] * dt_;
  }
}

}  // namespace fastball::sim_bullet
