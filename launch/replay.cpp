#include "launch/replay.h"

#include <fmt/format.h>

#include <set>
#include <thread>

#include "logger/log_reader.h"

namespace fastball::launch {

int64_t replayLog(const std::string& log_path,
                  const ReplayOptions& options,
                  messaging::LcmEndpoint& endpoint) {
  static const std::set<std::string> kCommands{"ARM_COMMAND", "HAND_COMMAND", "THROW_START",
                                               "SCENE"};
  using Steady = std::chrono::steady_clock;
  const Steady::time_point start = Steady::now();
  int64_t first_utime = -1;
  int64_t said = 0;
  logger::readLog(log_path, [&](const logger::LogEntry& entry) {
    if (!options.commands && kCommands.count(entry.channel) != 0)
      return;
    if (first_utime < 0)
      first_utime = entry.utime;
    const double delay_us = static_cast<double>(entry.utime - first_utime) / options.speed;
    std::this_thread::sleep_until(start +
                                  std::chrono::microseconds(static_cast<int64_t>(delay_us)));
    if (endpoint.publishBytes(entry.channel, entry.data.data(), entry.data.size()))
      ++said;
  });
  return said;
}

}  // namespace fastball::launch
