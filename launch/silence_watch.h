#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messaging/clock.h"
#include "messaging/endpoint.h"

namespace fastball::launch {

/// Notices who has stopped talking: a process that hangs, is stopped, or is cut off still runs as far as the system can tell,
/// but says no HEARTBEAT.
class SilenceWatch {
 public:
  SilenceWatch(messaging::Endpoint& endpoint, const messaging::Clock& clock);
  SilenceWatch(const SilenceWatch&) = delete;
  SilenceWatch& operator=(const SilenceWatch&) = delete;

  /// "controller has said no HEARTBEAT for 30.2 s" for each of `names` that was heard once and not in the last `limit` [s] of
  /// wall time; empty: none.
  std::string silentFor(double limit, const std::vector<std::string>& names) const;

 private:
  const messaging::Clock& clock_;
  std::map<std::string, int64_t> heard_us_;  ///< monotonic
};

}  // namespace fastball::launch
