#pragma once

#include "bench/held_ball.h"

namespace fastball::bench {

/// Seconds that MuJoCo takes for one step of 0.1 ms of the scene of `held`: the same links, drive inertias and ball, the same
/// servo and brake, contacts of ball and phalanges by its own elastic contact model (Newton, elliptic cone).
/// @throw std::runtime_error if MuJoCo refuses the scene or drops the ball.
double mujocoSecondsPerStep(const HeldBall& held);

}  // namespace fastball::bench
