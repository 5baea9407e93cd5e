#pragma once

#include <cstdint>
#include <string>

#include "logger/log_file.h"

namespace fastball::logger {

/// Writes messages to a log file in LCM's own format (readable by lcm-logplayer and every other LCM tool), and waits for the disk.
class LogWriter {
 public:
  /// @throw std::invalid_argument if the file cannot be created; names path and reason.
  explicit LogWriter(const std::string& path) : file_(path) {}
  /// Flushes; flush() before is what tells whether it worked.
  ~LogWriter();

  /// Appends one message. `utime`: when it was received [us since 1970].
  /// @throw std::invalid_argument unless it canBeRecorded(): a channel of 1 to 63 bytes, data of at
  ///   most 64 MiB.
  /// @throw std::runtime_error if the disk does not take it.
  void write(const std::string& channel, const void* data, std::size_t size, int64_t utime);
  /// Hands everything written so far to the operating system.
  /// @throw std::runtime_error if it does not take it.
  void flush();

  const std::string& path() const { return file_.path(); }
  int64_t messages() const { return messages_; }

 private:
  LogFile file_;
  std::string buffer_;
  int64_t messages_ = 0;
};

}  // namespace fastball::logger
