#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

model::BallState FlightEstimate::at(int64_t time, double gravity) const {
  return onward(start, seconds(utime, time), gravity);
}

model::BallState FlightEstimate::onward(const model::BallState& state,
                                        double duration,
                                        double gravity) const {
  return flyLifted(state, duration, drag, lift, gravity);
}

double FlightEstimate::sinceStart(int64_t time, int camera) const {
  const auto i = static_cast<std::size_t>(camera);
  return seconds(utime, time) - (i < clock.size() ? clock[i] : 0);
}

}  // namespace fastball::vision_tracker
