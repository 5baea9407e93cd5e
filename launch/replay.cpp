#include "launch/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "logger/channel_filter.h"
#include "logger/log_reader.h"
#include "messaging/clock.h"

namespace fastball::launch {
namespace {

constexpr double kSeconds = 1e-6;
/// [s] A message does not stand further behind one that was received later.
constexpr double kLongestReversal = 10;

bool movesRobot(const std::string& channel) {
  static const std::set<std::string> kCommands{
      messaging::kArmCommand.name, messaging::kHandCommand.name, messaging::kThrowStart.name,
      messaging::kScene.name,      messaging::kGrip.name,        messaging::kEstop.name};
  return kCommands.count(channel) != 0;
}

/// When each message is due, pauses included.
class Pace {
 public:
  Pace(double speed, ReplayConsole& console) : speed_(speed), console_(console) {}

  /// Waits until a message is due that was received `utime_us` after the first one that was said. @return false: stopped.
  bool await(int64_t utime_us) {
    const auto due_us = start_us_ + static_cast<int64_t>(static_cast<double>(utime_us) / speed_);
    while (!console_.stopped()) {
      const int64_t now_us = steadyUs();
      if (console_.paused()) {
        console_.wait(now_us + kPauseLookUs);
        paused_us_ += steadyUs() - now_us;
      } else if (now_us >= due_us + paused_us_) {
        return true;
      } else {
        console_.wait(due_us + paused_us_);
      }
    }
    return false;
  }

 private:
  static constexpr int64_t kPauseLookUs = 50'000;
  double speed_;
  ReplayConsole& console_;
  int64_t start_us_ = steadyUs();
  int64_t paused_us_ = 0;
};

}  // namespace

int64_t steadyUs() {
  return messaging::SystemClock().monotonicUs();
}

int64_t replayLog(const std::string& log_path,
                  const ReplayOptions& options,
                  messaging::LcmEndpoint& endpoint,
                  ReplayConsole& console) {
  logger::LogReader reader(log_path);
  logger::ChannelFilter filter(options.part.channels, options.part.excluded);
  logger::LogEntry entry;
  if (!reader.next(entry))
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", log_path));
  Pace pace(options.speed, console);
  const int64_t start_utime = entry.utime;
  const auto skipped_us = static_cast<int64_t>(options.part.from / kSeconds);
  int64_t said = 0;
  do {
    const int64_t utime = entry.utime - start_utime;
    if (kSeconds * static_cast<double>(utime) > options.part.to + kLongestReversal)
      break;
    const auto renamed = options.names.find(entry.channel);
    const std::string& name = renamed == options.names.end() ? entry.channel : renamed->second;
    if (!options.part.holds(entry.utime, start_utime) || !filter.wants(entry.channel) ||
        (movesRobot(name) && !options.commands))
      continue;
    if (!pace.await(std::max<int64_t>(utime - skipped_us, 0)))
      break;
    said += endpoint.publishRecorded(name, entry.data.data(), entry.data.size()) ? 1 : 0;
    console.show(kSeconds * static_cast<double>(utime),
                 static_cast<double>(reader.offset()) / static_cast<double>(reader.fileBytes()),
                 said);
  } while (reader.next(entry));
  return said;
}

}  // namespace fastball::launch
