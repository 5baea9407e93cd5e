#include "launch/throw_record.h"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <type_traits>

#include "logger/log_reader.h"
#include "messaging/channels.h"
#include "messaging/validation.h"

namespace fastball::launch {
namespace {

/// Appends a state; one that is said again, as in lockstep, is the same state.
template <class State>
void append(std::vector<State>& states, const State& state) {
  if (states.empty() || state.tick > states.back().tick)
    states.push_back(state);
}

/// Tells `visit` of every channel that a record is made of, and of what puts its messages where they belong.
template <class Visit>
void forEachChannel(std::map<int64_t, ThrowRecord>& throws, const Visit& visit) {
  using std::function;
  visit(messaging::kPlanRequest,
        function([&throws](const plan_request_t& m) { throws[m.request_id].request = m; }));
  visit(messaging::kSwingPlan,
        function([&throws](const swing_plan_t& m) { throws[m.plan_id].plan = m; }));
  visit(messaging::kScene, function([&throws](const scene_t& m) { throws[m.scene_id].scene = m; }));
  visit(messaging::kThrowStart,
        function([&throws](const throw_start_t& m) { throws[m.scene_id].start = m; }));
  visit(messaging::kRelease, function([&throws](const release_t& m) {
          ThrowRecord& record = throws[m.scene_id];
          (m.event == release_t::DEPARTED ? record.departed : record.commanded) = m;
        }));
  visit(messaging::kLanding,
        function([&throws](const landing_t& m) { throws[m.request_id].landing = m; }));
  visit(messaging::kBallTrack,
        function([&throws](const ball_track_t& m) { throws[m.request_id].track.push_back(m); }));
  visit(messaging::kArmState,
        function([&throws](const arm_state_t& m) { append(throws[m.scene_id].arm, m); }));
  visit(messaging::kHandState,
        function([&throws](const hand_state_t& m) { append(throws[m.scene_id].hand, m); }));
}

}  // namespace

std::map<int64_t, ThrowRecord> readThrows(const std::string& log_path) {
  std::map<int64_t, ThrowRecord> throws;
  std::map<std::string, std::function<void(const logger::LogEntry&)>> readers;
  forEachChannel(throws, [&readers](const auto& channel, const auto& put) {
    readers[channel.name] = [put](const logger::LogEntry& entry) {
      typename std::decay_t<decltype(channel)>::Message message{};
      if (entry.decode(message) && !messaging::fault(message))
        put(message);
    };
  });
  logger::readLog(log_path, [&readers](const logger::LogEntry& entry) {
    const auto reader = readers.find(entry.channel);
    if (reader != readers.end())
      reader->second(entry);
  });
  if (throws.empty())
    throw std::invalid_argument(fmt::format("'{}' holds no throw", log_path));
  return throws;
}

void recordThrows(messaging::Endpoint& endpoint, std::map<int64_t, ThrowRecord>& throws) {
  forEachChannel(throws, [&endpoint](const auto& channel, const auto& put) {
    endpoint.subscribe(channel, put);
  });
}

}  // namespace fastball::launch
