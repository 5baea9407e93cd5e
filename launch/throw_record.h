#pragma once

#include <map>
#include <optional>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "messaging/endpoint.h"

namespace fastball::launch {

/// What a run tells of one throw. A message that was not heard is absent; nothing here comes from SIM_TRUTH.
struct ThrowRecord {
  std::optional<plan_request_t> request;
  std::optional<swing_plan_t> plan;
  std::optional<scene_t> scene;
  std::optional<throw_start_t> start;
  std::optional<release_t> commanded, departed;
  std::optional<landing_t> landing;
  std::vector<arm_state_t> arm;     ///< one a tick, in order
  std::vector<hand_state_t> hand;   ///< one a tick, in order
  std::vector<ball_track_t> track;  ///< in order
};

/// Hears all throws of a run or of a log (launch/log_endpoint.h), by their number: subscribes to what a record is
/// made of. `throws` must outlive the endpoint.
void recordThrows(messaging::Endpoint& endpoint, std::map<int64_t, ThrowRecord>& throws);

}  // namespace fastball::launch
