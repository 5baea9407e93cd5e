#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "config/strict_yaml.h"
#include "model/arm_parameters.h"
#include "model/ball_parameters.h"
#include "model/hand_parameters.h"

namespace fastball::sim_bullet {

/// What can be wrong in a throw, as an uncertainty file gives it; a key left out means no such error. sd: standard deviation.
struct Uncertainty {
  double ball_offset_sd = 0;   ///< [m], of the ball in the hand, each axis
  double mass_rel_sd = 0;      ///< of the ball's mass, relative
  double drag_rel_sd = 0;      ///< of its drag coefficient, relative
  double encoder_bias_sd = 0;  ///< [rad], of each arm joint's reading
  double opening_delay_sd =
      0;  ///< [s], dead time of all fingers' commands: the magnitude of the draw
  double finger_delay_sd = 0;  ///< [s], of each finger's beyond that: the magnitude of the draw
  std::optional<config::Range> youngs_modulus;  ///< [Pa], even on a logarithmic scale
  std::optional<config::Range> friction;        ///< Coulomb mu between finger and ball, even
};

/// Reads an uncertainty file. @throw config::ConfigError for an unknown key, or a value beyond anything real.
Uncertainty loadUncertainty(const std::string& path);

/// The errors of one scene.
struct SceneErrors {
  Eigen::Vector3d ball_offset_H = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector4d encoder_bias = Eigen::Vector4d::Zero();   ///< [rad]
  std::array<double, model::kFingers> finger_delay{};       ///< [s], of the commands
  model::BallParameters ball;                               ///< as it really is
};

/// Draws the errors of a scene: the same for the same seed. No draw goes beyond three standard deviations. Each quantity has
/// its place in the sequence of random numbers, so that one more error does not change the others.
SceneErrors drawErrors(const Uncertainty& uncertainty,
                       const model::BallParameters& ball,
                       int64_t seed);

}  // namespace fastball::sim_bullet
