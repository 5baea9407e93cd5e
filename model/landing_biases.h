#pragma once

#include <Eigen/Core>

#include "model/ball_flight.h"
#include "model/ball_parameters.h"
#include "model/target.h"

namespace fastball::model {

/// What a set-up adds to every throw of it, beside what its models say: drag (share of the ball's own); velocity of the
/// leaving ball towards the target, to its left and up [m/s]; place of the target, right and up in its plane [m].
inline constexpr int kLandingBiases = 6;
using LandingBiases = Eigen::Matrix<double, kLandingBiases, 1>;
/// d landing (right, up) [m] / d biases.
using LandingJacobian = Eigen::Matrix<double, 2, kLandingBiases>;

/// How the biases move the landing of a ball that leaves so; central differences of the flight.
/// @param gravity [m/s^2], along -z of the world.
/// @throw std::invalid_argument if it does not reach the target's plane.
LandingJacobian landingJacobian(const BallState& release,
                                const Target& target,
                                const BallParameters& ball,
                                double gravity);

}  // namespace fastball::model
