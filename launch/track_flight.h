#pragma once

#include <cstdint>

#include "lcmtypes/fastball_types.h"
#include "model/ball_flight.h"

namespace fastball::launch {

/// The ball at another time `utime` [us] of the flight that a BALL_TRACK was fitted to, before or after the time of the message.
/// @param gravity [m/s^2]
/// @throw std::runtime_error if the two are more than a minute apart.
model::BallState flightAt(const ball_track_t& fit, int64_t utime, double gravity);

}  // namespace fastball::launch
