#include "launch/rest_watch.h"

#include <poll.h>

#include <Eigen/Core>
#include <utility>

namespace fastball::launch {
namespace {

// For the last commands to reach the robot and the log.
constexpr int64_t kEstopUs = 100'000;
// A busy machine may be that late with the next state; a simulator that waits for a dead process is
// silent for ever.
constexpr int64_t kSilentUs = 500'000;
constexpr double kRestSpeed = 0.02;  // [rad/s]

}  // namespace

RestWatch::RestWatch(messaging::LcmEndpoint& endpoint, const messaging::Clock& clock)
    : endpoint_(endpoint), clock_(clock) {
  endpoint_.subscribe<arm_state_t>(messaging::kArmState, [this](const auto& m) { arm_ = m; });
}

void RestWatch::await(int64_t longest_us) {
  const int64_t start_us = clock_.monotonicUs();
  int64_t heard_us = start_us, moved_us = start_us;
  int64_t tick = arm_.tick;
  for (int64_t now_us = start_us; now_us < start_us + longest_us; now_us = clock_.monotonicUs()) {
    pollfd readable{endpoint_.fileDescriptor(), POLLIN, 0};
    poll(&readable, 1, 10);
    endpoint_.drain();
    if (std::exchange(tick, arm_.tick) != arm_.tick)
      heard_us = now_us;
    if (Eigen::Map<const Eigen::Vector4d>(arm_.qd).norm() > kRestSpeed)
      moved_us = now_us;
    if (now_us >= moved_us + kEstopUs || now_us >= heard_us + kSilentUs)
      return;
  }
}

}  // namespace fastball::launch
