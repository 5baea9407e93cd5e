#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace fastball::logger {

/// Records on their way from the network to the disk, in bounded memory, for any threads. Whoever
/// adds never waits for whoever takes: where there is no room the record is dropped, and it is kept
/// in mind what was dropped and when.
class RecordQueue {
 public:
  /// @param max_bytes of records that wait
  explicit RecordQueue(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Adds one message as a record. `utime`: when it was received [us since 1970].
  /// @return false if it was dropped.
  bool add(std::string_view channel, std::string_view data, int64_t utime);
  /// Moves the oldest records into `records`, about a megabyte of them, as soon as there are so
  /// many, at the latest twice kLongestWait after the first of them has come; waits until one has.
  /// What was in `records` before counts as written. @return false if the queue is empty and
  /// closed.
  bool take(std::string& records);
  /// Ends the waiting of take(), and all that comes after this is dropped.
  void close();
  /// Counts records as dropped that were taken and cannot be written.
  void drop(std::string_view records);

  /// Messages of one channel that were dropped.
  struct Dropped {
    int64_t messages = 0;
    int64_t first_utime = 0;  ///< [us since 1970]
    int64_t last_utime = 0;   ///< [us since 1970]
  };
  std::map<std::string, Dropped> dropped() const;
  int64_t droppedMessages() const;
  /// [bytes] of the records that wait, those taken last included.
  std::size_t bytes() const;
  bool isClosed() const;

  /// [s] A killed process loses no more than it received in twice this.
  static constexpr double kLongestWait = 0.05;

 private:
  void countDropped(std::string_view channel, int64_t utime);

  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<std::string> chunks_;
  std::size_t bytes_ = 0;
  int64_t next_number_ = 0;
  bool closed_ = false;
  std::map<std::string, Dropped, std::less<>> dropped_;
  int64_t dropped_messages_ = 0;
};

}  // namespace fastball::logger
