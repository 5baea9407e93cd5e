#pragma once

#include "launch/figures/rolling_range.h"
#include "model/elastic_ball.h"

namespace fastball::launch {

/// A hand that pushes the ball with a flat finger plane, as the paper has it, while its push fades (CircleSwing): the load on
/// the fingers [N] falls evenly.
struct Unloading {
  model::BallParameters ball;
  model::FingerPair fingers;
  CircleSwing swing;
  double rate = 0;  ///< [N/s]
};
/// Unloading at `rate` [N/s] from 50 m/s^2.
/// @throw std::invalid_argument unless the rate is positive.
Unloading unloading(const model::BallParameters& ball, double rate);

/// The elastic ball, from rest on the loaded fingers. @param youngs_modulus [Pa]
model::ElasticMotion elasticRelease(const Unloading& unloading, double youngs_modulus);
/// The rigid ball.
model::RollingMotion rigidRelease(const Unloading& unloading);
/// Largest speed [m/s] at which the fingers give the ball free before it leaves.
double recovery(const model::ElasticMotion& motion);

}  // namespace fastball::launch
