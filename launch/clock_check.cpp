#include "launch/clock_check.h"

#include <fmt/format.h>

#include <cmath>

#include "messaging/heartbeat.h"

namespace fastball::launch {
namespace {

constexpr int kRounds = 8;
constexpr int64_t kIntervalUs = 30'000;

}  // namespace

ClockCheck::ClockCheck(messaging::Endpoint& endpoint,
                       const messaging::Clock& clock,
                       const Roster& roster)
    : clock_(clock), roster_(roster), survey_(endpoint, clock) {}

bool ClockCheck::update() {
  if (clock_.monotonicUs() < next_us_)
    return false;
  // The last answers have the time of a round as well.
  if (asked_ == kRounds)
    return true;
  survey_.ask();
  ++asked_;
  next_us_ = clock_.monotonicUs() + kIntervalUs;
  return false;
}

std::set<std::string> ClockCheck::otherHosts() const {
  std::set<std::string> hosts;
  for (const heartbeat_t& heartbeat : roster_.everyone())
    hosts.insert(heartbeat.host);
  hosts.erase(messaging::hostName());
  return hosts;
}

std::string ClockCheck::report() const {
  std::string text;
  for (const std::string& host : otherHosts()) {
    const auto clock = survey_.clocks().find(host);
    text += fmt::format("{}{} ", text.empty() ? "clocks: " : ", ", host);
    text += clock == survey_.clocks().end()
                ? "does not tell"
                : fmt::format("{:+.1f} ms (to {:.1f})", clock->second.offset * 1e3,
                              clock->second.error * 1e3);
  }
  return text;
}

std::string ClockCheck::fault(double limit) const {
  for (const auto& [host, clock] : survey_.clocks()) {
    if (std::abs(clock.offset) - clock.error <= limit)
      continue;
    return fmt::format(
        "the clock of {} is {:.1f} ms {} that of {}, clock_limit is {:.1f} ms: set both by one "
        "server (sudo apt install chrony)",
        host, std::abs(clock.offset) * 1e3, clock.offset > 0 ? "ahead of" : "behind",
        messaging::hostName(), limit * 1e3);
  }
  return "";
}

}  // namespace fastball::launch
