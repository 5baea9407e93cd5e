#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace lcm {
class LogFile;
}

namespace fastball::logger {

/// Writes messages to a log file in LCM's own format (readable by lcm-logplayer and every other LCM tool). Nothing is dropped
/// silently: what is known to be missing is counted.
class LogWriter {
 public:
  /// @throw std::invalid_argument if the file cannot be created; names path and reason.
  explicit LogWriter(const std::string& path);
  ~LogWriter();

  /// Appends one message. `utime`: when it was received [us since 1970]. Counts gaps in the sequence numbers of the channels
  /// that have one sender.
  void write(const std::string& channel, const void* data, std::size_t size, int64_t utime);
  /// Hands everything written so far to the operating system.
  void flush();

  const std::string& path() const { return path_; }
  int64_t messages() const { return messages_; }
  int64_t bytes() const { return bytes_; }
  /// Messages known to be missing: gaps in seq and failed writes.
  int64_t lost() const { return lost_; }
  /// Why writing failed, or empty.
  const std::string& failure() const { return failure_; }

 private:
  void countGaps(const std::string& channel, const void* data, std::size_t size);

  std::string path_;
  std::unique_ptr<lcm::LogFile> file_;
  std::map<std::string, int64_t> last_seq_;
  int64_t messages_ = 0;
  int64_t bytes_ = 0;
  int64_t lost_ = 0;
  std::string failure_;
};

}  // namespace fastball::logger
