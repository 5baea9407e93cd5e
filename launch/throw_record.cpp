#include "launch/throw_record.h"

#include "messaging/channels.h"

namespace fastball::launch {
namespace {

/// Appends a state; one that is said again, as in lockstep, is the same state.
template <class State>
void append(std::vector<State>& states, const State& state) {
  if (states.empty() || state.tick > states.back().tick)
    states.push_back(state);
}

}  // namespace

void recordThrows(messaging::Endpoint& endpoint, std::map<int64_t, ThrowRecord>& throws) {
  using namespace messaging;
  endpoint.subscribe<plan_request_t>(
      kPlanRequest, [&throws](const auto& m) { throws[m.request_id].request = m; });
  endpoint.subscribe<swing_plan_t>(kSwingPlan,
                                   [&throws](const auto& m) { throws[m.plan_id].plan = m; });
  endpoint.subscribe<scene_t>(kScene, [&throws](const auto& m) { throws[m.scene_id].scene = m; });
  endpoint.subscribe<throw_start_t>(kThrowStart,
                                    [&throws](const auto& m) { throws[m.scene_id].start = m; });
  endpoint.subscribe<release_t>(kRelease, [&throws](const auto& m) {
    ThrowRecord& record = throws[m.scene_id];
    (m.event == release_t::DEPARTED ? record.departed : record.commanded) = m;
  });
  endpoint.subscribe<landing_t>(kLanding,
                                [&throws](const auto& m) { throws[m.request_id].landing = m; });
  endpoint.subscribe<ball_track_t>(
      kBallTrack, [&throws](const auto& m) { throws[m.request_id].track.push_back(m); });
  endpoint.subscribe<arm_state_t>(kArmState,
                                  [&throws](const auto& m) { append(throws[m.scene_id].arm, m); });
  endpoint.subscribe<hand_state_t>(
      kHandState, [&throws](const auto& m) { append(throws[m.scene_id].hand, m); });
}

}  // namespace fastball::launch
