#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "logger/log_file.h"
#include "logger/record_queue.h"

namespace fastball::logger {

struct RecorderOptions {
  std::string path;  ///< of the log; with splitting, run.lcmlog becomes run.000.lcmlog, ...
  std::size_t buffer_bytes = std::size_t{256} << 20;  ///< of messages that wait for the disk
  int64_t split_bytes = 0;  ///< a file of several messages gets no longer than this, 0: any length
  int64_t split_us = 0;     ///< a file spans no more than this receive time, 0: any time
  int keep = 0;             ///< so many files are kept and older ones of this run removed, 0: all
};

/// Writes messages to a log file or a row of them, on a thread of its own: whoever receives never
/// waits for the disk. While the disk is slow or full, messages wait in a bounded buffer; what does
/// not fit is dropped and counted, and writing goes on when there is room again. add() and status()
/// may be called from any thread.
class Recorder {
 public:
  /// @throw std::invalid_argument if the file cannot be created.
  explicit Recorder(RecorderOptions options);
  /// Stops, if stop() has not been called.
  ~Recorder();

  /// Takes a message to be written, received at `utime` [us since 1970].
  /// @return false if it was dropped.
  bool add(std::string_view channel, std::string_view data, int64_t utime) {
    return queue_.add(channel, data, utime);
  }
  /// Writes what is still in the buffer; what the disk does not take then is dropped.
  void stop();

  struct Status {
    std::vector<std::string> files;  ///< that exist, the newest last
    int64_t messages = 0;            ///< written
    int64_t bytes = 0;               ///< of their data
    std::string failure;             ///< why nothing can be written at present, or empty
  };
  Status status() const;
  const RecordQueue& queue() const { return queue_; }

 private:
  void writeAll();
  bool write(std::string_view& records);
  std::size_t fittingBytes(std::string_view records);
  bool openNext();
  void countWritten(std::string_view records);
  bool fail(const std::string& why);
  std::string filePath(int number) const;

  const RecorderOptions options_;
  RecordQueue queue_;
  std::unique_ptr<LogFile> file_;
  int next_file_ = 0;
  int64_t file_start_utime_ = 0;
  mutable std::mutex status_mutex_;
  Status status_;
  std::thread writer_;
};

}  // namespace fastball::logger
