#include "hand_server/ball_watch.h"

#include <algorithm>
#include <cmath>

#include "hand_server/departure_time.h"

namespace fastball::hand_server {
namespace {

/// A finger that lost the ball more ticks before the last one has no say in when it left.
constexpr std::size_t kLate = 2;

}  // namespace

std::optional<BallWatch::Departure> BallWatch::step(int64_t utime, const FingerForces& force) {
  if (departure_)
    return {};
  newest_ = (newest_ + 1) % kKept;
  states_[newest_] = {utime, force};
  feel();
  std::optional<std::size_t> quiet;
  for (const auto& ticks : quiet_ticks_) {
    if (ticks && (!quiet || *ticks < *quiet))
      quiet = ticks;
  }
  if (!quiet || utime - past(std::min(*quiet, kKept - 1)).utime < quiet_us_)
    return {};
  departure_ = estimate();
  return departure_;
}

/// A ball that a finger barely presses is in no single reading, but right after a touch two together feel it still.
void BallWatch::feel() {
  for (int i = 0; i < model::kFingers; ++i) {
    std::optional<std::size_t>& quiet = quiet_ticks_[i];
    if (quiet)
      ++*quiet;
    const double now = past(0).force[i];
    if (now >= settings_.touch_force)
      quiet = 0;
    else if (quiet == std::size_t{2} && past(1).force[i] + now >= settings_.touch_force)
      quiet = 1;
  }
}

BallWatch::Departure BallWatch::estimate() const {
  std::size_t last = kKept;
  for (const auto& quiet : quiet_ticks_)
    last = std::min(last, quiet.value_or(kKept));
  last = std::min(last, kKept - 2);
  const State& touch = past(last);
  double end = -1;  // [ms] after that state
  for (int i = 0; i < model::kFingers; ++i) {
    const std::size_t quiet = quiet_ticks_[i].value_or(kKept);
    if (quiet > last + kLate || quiet + 1 >= kKept || quiet == 0)
      continue;
    std::array<ForceReading, 3> readings;
    for (std::size_t k = 0; k < readings.size(); ++k) {
      const State& state = past(quiet + 1 - k);
      readings[k] = {1e-3 * static_cast<double>(state.utime - touch.utime), state.force[i]};
    }
    end = std::max(end, endOfForce(readings, settings_.noise));
  }
  return {touch.utime + std::llround(1e3 * end - 1e6 * settings_.delay), touch.utime, touch.force};
}

std::optional<model::Finger> BallWatch::touchedAgain(const FingerForces& force) {
  if (!departure_ || touched_again_)
    return {};
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    if (force[finger] >= settings_.touch_force) {
      touched_again_ = true;
      return finger;
    }
  }
  return {};
}

}  // namespace fastball::hand_server
