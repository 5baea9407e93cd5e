#include "launch/track_flight.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace fastball::launch {
namespace {

constexpr double kLongestFlight = 60;  ///< [s]

}  // namespace

model::BallState flightAt(const ball_track_t& fit, int64_t utime, double gravity) {
  const Eigen::Map<const Eigen::Vector3d> p(fit.p_WBall), v(fit.v_WBall);
  const double t = 1e-6 * static_cast<double>(utime - fit.utime);
  if (!(std::abs(t) < kLongestFlight))
    throw std::runtime_error(fmt::format(
        "BALL_TRACK is {:.0f} s from the time that is asked for, no flight is longer than {:.0f} s",
        std::abs(t), kLongestFlight));
  return model::fly({p, v}, t, fit.drag, gravity);
}

}  // namespace fastball::launch
