#include "launch/spy/spy_loop.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

/// LCM's own thread receives; to be woken for each message would cost more than the message.
constexpr int64_t kDrainUs = 20'000;
constexpr double kMicroseconds = 1e6;

/// Waits for keys or the end. @return true if keys wait.
bool waitFor(int64_t us, const messaging::StopSignals& signals, bool keys) {
  pollfd waits[] = {{signals.fileDescriptor(), POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
  const auto milliseconds = static_cast<int>((std::max<int64_t>(us, 0) + 999) / 1000);
  // A change of the window's size is a signal, which ends the wait, and a key of the terminal's library.
  return poll(waits, keys ? 2 : 1, milliseconds) != 0 && keys;
}

}  // namespace

void spy(const SpyOptions& options, const messaging::TypeLibrary& types, SpyOutput& output) {
  const messaging::StopSignals signals;
  const messaging::SystemClock clock;
  messaging::LcmEndpoint endpoint(options.lcm_url);
  Traffic traffic(types);
  endpoint.subscribeRaw(options.channel, [&traffic](const std::string& channel, const void* data,
                                                    std::size_t size, int64_t utime) {
    if (channel != messaging::kSelfTestChannel)
      traffic.take(channel, data, size, utime);
  });
  const auto interval_us =
      std::max<int64_t>(static_cast<int64_t>(kMicroseconds * options.interval_s), 1);
  const int64_t start = clock.monotonicUs();
  const int64_t end = options.duration_s > 0
                          ? start + static_cast<int64_t>(kMicroseconds * options.duration_s)
                          : std::numeric_limits<int64_t>::max();
  int64_t next_show = start + interval_us;
  bool wanted = true;
  for (int64_t now = start; wanted && now < end && !signals.received(); now = clock.monotonicUs()) {
    if (now >= next_show) {
      output.show(traffic, clock.wallUs());
      // On time again after a pause of the process, without making up for what it missed.
      next_show += interval_us * ((now - next_show) / interval_us + 1);
    }
    const int64_t until = std::min({end, next_show, now + kDrainUs});
    const bool keys = waitFor(until - now, signals, output.hasKeys());
    endpoint.drain();
    wanted = !keys || output.readKeys(traffic, clock.wallUs());
  }
  output.show(traffic, clock.wallUs());
}

}  // namespace fastball::launch
