#include "vision_tracker/flight_estimate.h"

namespace fastball::vision_tracker {

model::BallState FlightEstimate::at(int64_t time, double gravity) const {
  return model::fly(start, seconds(utime, time), drag, gravity);
}

}  // namespace fastball::vision_tracker
