#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "logger/record_format.h"
#include "messaging/command_trailer.h"
#include "messaging/message_type.h"

namespace fastball::logger {

/// One recorded message, still encoded.
struct LogEntry {
  int64_t utime = 0;  ///< [us since 1970], when it was received
  std::string channel;
  std::vector<char> data;

  /// Decodes into T. @return false if the bytes are not a T from first to last, but for a command's trailer. Any bytes are safe.
  template <class T>
  bool decode(T& message) const {
    return messaging::decodeWithoutTrailer(messaging::messageType<T>(), &message, data.data(),
                                           data.size());
  }
};

/// Reads a log from front to back and finds its way again after damage: every record that is whole is read. LCM's own reader is
/// not used because it gives up the record before a damaged one too. Needs memory for one record, whatever the file says.
class LogReader {
 public:
  /// @throw std::invalid_argument if the file cannot be read; names path and reason.
  explicit LogReader(std::string path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// @return false at the end of the file.
  /// @throw std::runtime_error if the disk fails.
  bool next(LogEntry& entry);

  /// Part of the file that is no whole record.
  struct Damage {
    int64_t offset = 0;  ///< [bytes] from the start of the file
    int64_t bytes = 0;
  };
  /// The first kMaxDamages damages that were stepped over.
  const std::vector<Damage>& damages() const { return damages_; }
  static constexpr std::size_t kMaxDamages = 1000;
  /// Places stepped over, however many.
  int damageCount() const { return damage_count_; }
  int64_t damagedBytes() const { return damaged_bytes_; }

  const std::string& path() const { return path_; }
  int64_t fileBytes() const { return file_bytes_; }
  /// Where the next record is expected [bytes].
  int64_t offset() const { return offset_; }
  /// Back to the first record; forgets the damages found.
  void rewind();
  /// Goes on with the record at `offset` [bytes], where offset() was before that record was read. Damages found stay counted.
  void seek(int64_t offset) { offset_ = offset; }

 private:
  bool headerAt(int64_t offset, RecordHeader& header, std::string& channel);
  bool beginsRecord(int64_t offset);
  bool takeRecord(LogEntry& entry);
  void skipDamage(int64_t from);
  int64_t findRecord(int64_t from);
  std::size_t bytesOfWindow(int64_t offset) const;
  std::size_t readAt(int64_t offset, char* bytes, std::size_t size);
  std::size_t readWindow(std::size_t ahead, char* bytes, std::size_t size) const;
  std::size_t readFile(int64_t offset, char* bytes, std::size_t size) const;

  std::string path_;
  int file_ = -1;
  std::vector<char> window_;  // of the file, from window_offset_ on
  int64_t window_offset_ = 0;
  int64_t file_bytes_ = 0;
  int64_t offset_ = 0;
  std::vector<Damage> damages_;
  int damage_count_ = 0;
  int64_t damaged_bytes_ = 0;
};

/// Calls `handler` for every message of a log, in the order of the file; damage is stepped over.
/// @return how many damages there were.
/// @throw std::invalid_argument if the file cannot be read or holds no message at all.
/// @throw std::runtime_error if the disk fails.
int readLog(const std::string& path, const std::function<void(const LogEntry&)>& handler);

}  // namespace fastball::logger
