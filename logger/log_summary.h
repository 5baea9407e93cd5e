#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "logger/log_reader.h"
#include "messaging/type_library.h"

namespace fastball::logger {

/// What a log holds on one channel.
struct ChannelSummary {
  std::string type;  ///< name of the type, "several", or what is known of it
  int64_t messages = 0;
  int64_t bytes = 0;                ///< of the messages, encoded
  int64_t first_utime = 0;          ///< [us since 1970], received
  int64_t last_utime = 0;           ///< [us since 1970]
  int64_t longest_pause_us = 0;     ///< between two messages
  int64_t longest_pause_utime = 0;  ///< when it began
  int64_t gaps = 0;                 ///< in the sequence numbers
  int64_t missing = 0;              ///< messages, by these gaps
  int64_t undecodable = 0;  ///< messages whose type is known and whose bytes are not one of it

  /// [Hz] from the first message to the last; 0: there is only one.
  double rate() const;
};

/// What a log holds, and what is wrong with it.
struct LogSummary {
  std::string path;
  int64_t file_bytes = 0;
  int64_t messages = 0;
  int64_t first_utime = 0, last_utime = 0;  ///< [us since 1970], earliest and latest
  std::map<std::string, ChannelSummary> channels;
  int64_t reversals = 0;  ///< messages that were received before the one that stands before them
  int64_t longest_reversal_us = 0;
  int damages = 0;  ///< places that are no record
  int64_t damaged_bytes = 0;
  std::vector<LogReader::Damage> first_damages;  ///< at most LogReader::kMaxDamages

  /// One sentence for everything that is wrong, empty: nothing. LCM's receive times step back a little on a busy machine: steps
  /// of up to `tolerated_reversal_us` are no fault.
  std::vector<std::string> faults(int64_t tolerated_reversal_us = 0) const;
};

/// Reads a log from end to end.
/// @throw std::invalid_argument if it cannot be read or holds no message.
/// @throw std::runtime_error if the disk fails.
LogSummary summarise(const std::string& path, const messaging::TypeLibrary& types);

/// The summary as a table, one line a channel; dates in local time.
std::string summaryText(const LogSummary& summary);

}  // namespace fastball::logger
