#include "logger/log_reader.h"

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace fastball::logger {
namespace {

bool atEnd(std::FILE* file) {
  const int next = std::fgetc(file);
  if (next == EOF)
    return true;
  std::ungetc(next, file);
  return false;
}

}  // namespace

int readLog(const std::string& path, const std::function<void(const LogEntry&)>& handler) {
  errno = 0;
  lcm::LogFile file(path, "r");
  if (!file.good())
    throw std::invalid_argument(
        fmt::format("cannot read the log file '{}': {}", path, std::strerror(errno)));
  int damaged = 0;
  int64_t messages = 0;
  LogEntry entry;
  for (;;) {
    const lcm::LogEvent* event = file.readNextEvent();
    if (!event) {
      // The reader gives up at a bad record, and finds the next good one when it is asked again.
      if (atEnd(file.getFilePtr()))
        break;
      ++damaged;
      continue;
    }
    ++messages;
    entry.utime = event->timestamp;
    entry.channel = event->channel;
    const char* data = static_cast<const char*>(event->data);
    entry.data.assign(data, data + event->datalen);
    handler(entry);
  }
  if (messages == 0)
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", path));
  return damaged;
}

}  // namespace fastball::logger
