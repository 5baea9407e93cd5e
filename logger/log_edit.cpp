#include "logger/log_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "logger/channel_filter.h"
#include "logger/log_reader.h"
#include "logger/log_writer.h"

namespace fastball::logger {
namespace {

constexpr double kMicroseconds = 1e6;

/// A log of a merge, with its next message.
struct Source {
  explicit Source(const std::string& path) : reader(path) { advance(); }
  void advance() { ended = !reader.next(entry); }
  LogReader reader;
  LogEntry entry;
  bool ended = false;
};

void refuseExisting(const std::string& path) {
  if (std::filesystem::exists(path))
    throw std::invalid_argument(fmt::format("'{}' exists already and is not overwritten", path));
}

void write(LogWriter& writer, const LogEntry& entry) {
  writer.write(entry.channel, entry.data.data(), entry.data.size(), entry.utime);
}

}  // namespace

bool LogPart::holds(int64_t utime, int64_t start_utime) const {
  // Divided, so that 0.2 s is the same number as a user's.
  const double time = static_cast<double>(utime - start_utime) / kMicroseconds;
  return from <= time && time <= to;
}

CopyResult copyLog(const std::string& path, const std::string& new_path, const LogPart& part) {
  LogReader reader(path);
  ChannelFilter filter(part.channels, part.excluded);
  LogEntry entry;
  if (!reader.next(entry))
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", path));
  refuseExisting(new_path);
  LogWriter writer(new_path);
  const int64_t start_utime = entry.utime;
  do {
    if (part.holds(entry.utime, start_utime) && filter.wants(entry.channel))
      write(writer, entry);
  } while (reader.next(entry));
  writer.flush();
  return {writer.messages(), reader.damageCount(), reader.damagedBytes()};
}

CopyResult mergeLogs(const std::vector<std::string>& paths, const std::string& new_path) {
  if (paths.empty())
    throw std::invalid_argument("there is no log to merge");
  std::vector<std::unique_ptr<Source>> sources;
  sources.reserve(paths.size());
  for (const std::string& path : paths)
    sources.push_back(std::make_unique<Source>(path));
  refuseExisting(new_path);
  LogWriter writer(new_path);
  const auto before = [](const auto& a, const auto& b) {
    return a->ended != b->ended ? b->ended : a->entry.utime < b->entry.utime;
  };
  for (;;) {
    Source& next = **std::min_element(sources.begin(), sources.end(), before);
    if (next.ended)
      break;
    write(writer, next.entry);
    next.advance();
  }
  writer.flush();
  CopyResult result{writer.messages(), 0, 0};
  for (const auto& source : sources) {
    result.damages += source->reader.damageCount();
    result.damaged_bytes += source->reader.damagedBytes();
  }
  return result;
}

}  // namespace fastball::logger
