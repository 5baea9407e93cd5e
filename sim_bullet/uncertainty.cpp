#include "sim_bullet/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace fastball::sim_bullet {
namespace {

/// Draws beyond this many standard deviations are moved to it.
constexpr double kMostSigmas = 3;

double optionalNumber(config::Section& file, const std::string& key, double most) {
  return file.has(key) ? file.number(key, {0, most}) : 0;
}

std::optional<config::Range> optionalRange(config::Section& file,
                                           const std::string& key,
                                           config::Range allowed) {
  if (!file.has(key))
    return std::nullopt;
  const Eigen::VectorXd ends = file.vector(key, 2, allowed);
  if (ends[0] > ends[1])
    throw file.error(key, "must give the lower end first");
  return config::Range{ends[0], ends[1]};
}

class Draw {
 public:
  explicit Draw(int64_t seed) : engine_(static_cast<uint64_t>(seed)) {}
  double normal(double sd) { return sd * std::clamp(normal_(engine_), -kMostSigmas, kMostSigmas); }
  double between(double low, double high) { return low + (high - low) * uniform_(engine_); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

}  // namespace

// The bounds keep three standard deviations inside what a ball and a hand can be.
Uncertainty loadUncertainty(const std::string& path) {
  config::Section file = config::Section::fromFile(path);
  Uncertainty result;
  result.ball_offset_sd = optionalNumber(file, "ball_offset_sd", 0.01);
  result.mass_rel_sd = optionalNumber(file, "mass_rel_sd", 0.2);
  result.drag_rel_sd = optionalNumber(file, "drag_rel_sd", 0.3);
  result.encoder_bias_sd = optionalNumber(file, "encoder_bias_sd", 0.02);
  result.opening_delay_sd = optionalNumber(file, "opening_delay_sd", 0.02);
  result.finger_delay_sd = optionalNumber(file, "finger_delay_sd", 0.01);
  result.youngs_modulus = optionalRange(file, "youngs_modulus", {6e4, 1e7});
  result.friction = optionalRange(file, "friction", {0.05, 3});
  file.finish();
  return result;
}

SceneErrors drawErrors(const Uncertainty& uncertainty,
                       const model::BallParameters& ball,
                       int64_t seed) {
  Draw draw(seed);
  SceneErrors errors;
  errors.ball = ball;
  for (int i = 0; i < 3; ++i)
    errors.ball_offset_H[i] = draw.normal(uncertainty.ball_offset_sd);
  for (int i = 0; i < model::kArmJoints; ++i)
    errors.encoder_bias[i] = draw.normal(uncertainty.encoder_bias_sd);
  errors.finger_delay.fill(std::abs(draw.normal(uncertainty.opening_delay_sd)));
  errors.ball.mass *= 1 + draw.normal(uncertainty.mass_rel_sd);
  errors.ball.drag_coefficient *= 1 + draw.normal(uncertainty.drag_rel_sd);
  const double modulus = draw.between(0, 1);
  if (uncertainty.youngs_modulus) {
    const auto [low, high] = *uncertainty.youngs_modulus;
    errors.ball.youngs_modulus = low * std::pow(high / low, modulus);
  }
  const double friction = draw.between(0, 1);
  if (uncertainty.friction) {
    const auto [low, high] = *uncertainty.friction;
    errors.ball.friction = low + (high - low) * friction;
  }
  for (double& delay : errors.finger_delay)
    delay += std::abs(draw.normal(uncertainty.finger_delay_sd));
  return errors;
}

}  // namespace fastball::sim_bullet
