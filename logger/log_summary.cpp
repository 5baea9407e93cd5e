#include "logger/log_summary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "logger/sequence_gaps.h"

namespace fastball::logger {
namespace {

constexpr double kSeconds = 1e-6;
constexpr std::size_t kFingerprintBytes = 8;
constexpr std::size_t kPlacesNamed = 10;

std::string typeName(const messaging::TypeLibrary& types, const std::vector<char>& data) {
  const auto* type = types.typeOf(data.data(), data.size());
  if (type != nullptr)
    return type->name;
  if (data.size() < kFingerprintBytes)
    return "none";
  return fmt::format("unknown 0x{:016x}", static_cast<uint64_t>(int64At(data.data())));
}

std::string date(int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03d}", local, utime / 1000 % 1000);
}

/// Takes the messages of a log one after the other.
class Summary {
 public:
  Summary(LogSummary& summary, const messaging::TypeLibrary& types)
      : summary_(summary), types_(types), gaps_(types) {}

  void take(const LogEntry& entry) {
    takeTime(entry.utime);
    auto& channel = summary_.channels[entry.channel];
    takeType(channel, entry);
    const int64_t missing =
        gaps_.missingBefore(entry.channel, entry.data.data(), entry.data.size());
    channel.missing += missing;
    channel.gaps += missing > 0 ? 1 : 0;
    if (channel.messages++ == 0) {
      channel.first_utime = channel.last_utime = entry.utime;
    } else if (entry.utime - channel.last_utime > channel.longest_pause_us) {
      channel.longest_pause_us = entry.utime - channel.last_utime;
      channel.longest_pause_utime = channel.last_utime;
    }
    channel.last_utime = std::max(channel.last_utime, entry.utime);
    channel.bytes += static_cast<int64_t>(entry.data.size());
  }

 private:
  void takeTime(int64_t utime) {
    if (summary_.messages++ == 0) {
      summary_.first_utime = summary_.last_utime = utime;
    } else if (utime < before_) {
      ++summary_.reversals;
      summary_.longest_reversal_us = std::max(summary_.longest_reversal_us, before_ - utime);
    }
    before_ = utime;
    summary_.first_utime = std::min(summary_.first_utime, utime);
    summary_.last_utime = std::max(summary_.last_utime, utime);
  }

  void takeType(ChannelSummary& channel, const LogEntry& entry) {
    const std::string name = typeName(types_, entry.data);
    if (channel.messages == 0)
      channel.type = name;
    else if (channel.type != name)
      channel.type = "several";
    if (types_.typeOf(entry.data.data(), entry.data.size()) != nullptr &&
        !types_.fields(entry.data.data(), entry.data.size()))
      ++channel.undecodable;
  }

  LogSummary& summary_;
  const messaging::TypeLibrary& types_;
  SequenceGaps gaps_;
  int64_t before_ = 0;
};

}  // namespace

double ChannelSummary::rate() const {
  return last_utime > first_utime ? static_cast<double>(messages - 1) /
                                        (kSeconds * static_cast<double>(last_utime - first_utime))
                                  : 0;
}

LogSummary summarise(const std::string& path, const messaging::TypeLibrary& types) {
  LogReader reader(path);
  LogSummary result;
  Summary summary(result, types);
  for (LogEntry entry; reader.next(entry);)
    summary.take(entry);
  if (result.messages == 0)
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", path));
  result.path = path;
  result.file_bytes = reader.fileBytes();
  result.damages = reader.damageCount();
  result.damaged_bytes = reader.damagedBytes();
  result.first_damages = reader.damages();
  return result;
}

std::vector<std::string> LogSummary::faults(int64_t tolerated_reversal_us) const {
  std::vector<std::string> all;
  for (const auto& [name, channel] : channels) {
    if (channel.missing > 0)
      all.push_back(fmt::format("{}: {} messages missing in {} gaps of its sequence numbers", name,
                                channel.missing, channel.gaps));
    if (channel.undecodable > 0)
      all.push_back(fmt::format("{}: {} messages do not decode to their type {}", name,
                                channel.undecodable, channel.type));
  }
  if (longest_reversal_us > tolerated_reversal_us)
    all.push_back(
        fmt::format("{} messages stand behind one that was received later, by up to {:.3f} ms",
                    reversals, 1e-3 * static_cast<double>(longest_reversal_us)));
  for (std::size_t i = 0; i < std::min(first_damages.size(), kPlacesNamed); ++i)
    all.push_back(fmt::format("{} bytes from byte {} on are no record", first_damages[i].bytes,
                              first_damages[i].offset));
  if (damages > static_cast<int>(kPlacesNamed))
    all.push_back(fmt::format("{} bytes in {} places are no record", damaged_bytes, damages));
  return all;
}

std::string summaryText(const LogSummary& summary) {
  const double seconds = kSeconds * static_cast<double>(summary.last_utime - summary.first_utime);
  std::string text =
      fmt::format("{}: {} messages, {:.1f} MB, {:.3f} s from {} to {}\n", summary.path,
                  summary.messages, 1e-6 * static_cast<double>(summary.file_bytes), seconds,
                  date(summary.first_utime), date(summary.last_utime));
  std::size_t width = 7;
  std::size_t type_width = 4;
  for (const auto& [name, channel] : summary.channels) {
    width = std::max(width, name.size());
    type_width = std::max(type_width, channel.type.size());
  }
  text += fmt::format("{:{}}  {:{}} {:>9} {:>9} {:>11} {:>10} {:>10} {:>9} {:>8}\n", "channel",
                      width, "type", type_width, "messages", "Hz", "bytes", "first [s]", "last [s]",
                      "pause [s]", "missing");
  const auto since = [&](int64_t utime) {
    return kSeconds * static_cast<double>(utime - summary.first_utime);
  };
  for (const auto& [name, channel] : summary.channels) {
    text += fmt::format("{:{}}  {:{}} {:>9} {:>9.1f} {:>11} {:>10.3f} {:>10.3f} {:>9.3f} {:>8}\n",
                        name, width, channel.type, type_width, channel.messages, channel.rate(),
                        channel.bytes, since(channel.first_utime), since(channel.last_utime),
                        kSeconds * static_cast<double>(channel.longest_pause_us), channel.missing);
  }
  return text;
}

}  // namespace fastball::logger
