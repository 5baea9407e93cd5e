#include "messaging/clock.h"

#include <chrono>

namespace fastball::messaging {
namespace {

template <class TimePoint>
int64_t microseconds(TimePoint time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

}  // namespace

int64_t SystemClock::monotonicUs() const {
  return microseconds(std::chrono::steady_clock::now());
}

int64_t SystemClock::wallUs() const {
  return microseconds(std::chrono::system_clock::now());
}

}  // namespace fastball::messaging
