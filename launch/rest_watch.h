#pragma once

#include <cstdint>

#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {

/// Sees the arm come to rest after an ESTOP, by its ARM_STATEs.
class RestWatch {
 public:
  /// Both must live as long.
  RestWatch(messaging::LcmEndpoint& endpoint, const messaging::Clock& clock);
  RestWatch(const RestWatch&) = delete;
  RestWatch& operator=(const RestWatch&) = delete;

  /// Drains the endpoint until the arm has rested for a tenth of a second, so that the last
  /// commands have reached the robot and the log; until no new state has come for half a second; or
  /// for `longest_us` [us] of wall time.
  void await(int64_t longest_us);

 private:
  messaging::LcmEndpoint& endpoint_;
  const messaging::Clock& clock_;
  arm_state_t arm_{};  ///< the newest
};

}  // namespace fastball::launch
