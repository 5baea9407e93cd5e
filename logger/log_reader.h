#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fastball::logger {

/// One recorded message, still encoded.
struct LogEntry {
  int64_t utime = 0;  ///< [us since 1970], when it was received
  std::string channel;
  std::vector<char> data;

  /// Decodes into T. @return false if the bytes are not a T from first to last.
  template <class T>
  bool decode(T& message) const {
    const int size = static_cast<int>(data.size());
    return message.decode(data.data(), 0, size) == size;
  }
};

/// Calls `handler` for every message of a log, in the order of the file. A damaged record is stepped over,
/// and with it the one before: LCM's reader takes a record only if the next one begins soundly.
/// @return how often the reader had to step over something.
/// @throw std::invalid_argument if the file cannot be read or holds no message at all.
int readLog(const std::string& path, const std::function<void(const LogEntry&)>& handler);

}  // namespace fastball::logger
