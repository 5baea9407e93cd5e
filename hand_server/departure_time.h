#pragma once

#include <array>

namespace fastball::hand_server {

/// A finger's normal force as read at a tick.
struct ForceReading {
  double time = 0;   ///< [ms], end of the tick over which the force is a mean
  double force = 0;  ///< [N]
};

/// Time [ms] at which a finger's force has gone to nothing, from its last three readings: the last but one and the last that feel
/// the ball, and the one after it.
///
/// Without damping the force of Eq. (27) near the end is pi E y^2 and y falls linearly, so that sqrt(F) would be linear in time.
/// Damping takes F to zero before y, and there F itself is linear. In between, F = b (t_end - t)^1.25 is within some percent of
/// the contact law at the ball's damping ratio of 0.2 for the last two milliseconds. Its means over the ticks are fitted to the
/// readings, b and t_end free, t_end within a tick of the last that feels the ball. Does not allocate.
/// @param noise [N], standard deviation of a reading.
double endOfForce(const std::array<ForceReading, 3>& readings, double noise);

}  // namespace fastball::hand_server
