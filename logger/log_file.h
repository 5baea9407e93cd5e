#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fastball::logger {

/// An LCM log file being written, by one thread. Its own writing, because LCM's cannot say which
/// records reached the disk and leaves half a record where there was no room for the whole.
class LogFile {
 public:
  /// Creates the file or empties it. @throw std::invalid_argument if it cannot; names path and reason.
  explicit LogFile(std::string path);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Hands records to the operating system. @return how many bytes of `records` it took, always whole records; fewer than
  /// all means that failure() says why, and that the rest may be tried again.
  std::size_t append(std::string_view records);
  /// Why the last append() did not take all, or empty.
  const std::string& failure() const { return failure_; }
  int64_t bytes() const { return bytes_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_;
  int64_t bytes_ = 0;
  std::string failure_;
};

/// Appends one record to `records`, of a message that canBeRecorded(). `utime`: [us since 1970].
void appendRecord(std::string& records,
                  int64_t number,
                  int64_t utime,
                  std::string_view channel,
                  std::string_view data);

/// Length [bytes] of the record at the start of `records`, which must hold whole records; 0 at
/// their end.
std::size_t firstRecordBytes(std::string_view records);

}  // namespace fastball::logger
