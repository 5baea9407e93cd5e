#include "launch/throw_record.h"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>

#include "logger/log_reader.h"
#include "messaging/channels.h"
#include "messaging/validation.h"

namespace fastball::launch {
namespace {

/// Decoders by channel; each puts a sound message where it belongs and passes over any other.
class ThrowReader {
 public:
  ThrowReader() {
    keep(messaging::kPlanRequest,
         [this](const plan_request_t& m) { at(m.request_id).request = m; });
    keep(messaging::kSwingPlan, [this](const swing_plan_t& m) { at(m.plan_id).plan = m; });
    keep(messaging::kScene, [this](const scene_t& m) { at(m.scene_id).scene = m; });
    keep(messaging::kThrowStart, [this](const throw_start_t& m) { at(m.scene_id).start = m; });
    keep(messaging::kRelease, [this](const release_t& m) {
      (m.event == release_t::DEPARTED ? at(m.scene_id).departed : at(m.scene_id).commanded) = m;
    });
    keep(messaging::kLanding, [this](const landing_t& m) { at(m.request_id).landing = m; });
    keep(messaging::kBallTrack,
         [this](const ball_track_t& m) { at(m.request_id).track.push_back(m); });
    keep(messaging::kArmState, [this](const arm_state_t& m) {
      auto& arm = at(m.scene_id).arm;
      if (arm.empty() || m.tick > arm.back().tick)  // a state said again is the same state
        arm.push_back(m);
    });
  }

  void read(const logger::LogEntry& entry) {
    const auto reader = readers_.find(entry.channel);
    if (reader != readers_.end())
      reader->second(entry);
  }

  std::map<int64_t, ThrowRecord> throws;

 private:
  ThrowRecord& at(int64_t number) { return throws[number]; }

  template <class T, class Put>
  void keep(const messaging::Channel<T>& channel, Put put) {
    readers_[channel.name] = [put](const logger::LogEntry& entry) {
      T message{};
      if (entry.decode(message) && !messaging::fault(message))
        put(message);
    };
  }

  std::map<std::string, std::function<void(const logger::LogEntry&)>> readers_;
};

}  // namespace

std::map<int64_t, ThrowRecord> readThrows(const std::string& log_path) {
  ThrowReader reader;
  logger::readLog(log_path, [&](const logger::LogEntry& entry) { reader.read(entry); });
  if (reader.throws.empty())
    throw std::invalid_argument(fmt::format("'{}' holds no throw", log_path));
  return std::move(reader.throws);
}

}  // namespace fastball::launch
