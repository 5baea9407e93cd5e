#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// New logs made of old ones. None of them overwrites a file; each reads past damage.
namespace fastball::logger {

struct CopyResult {
  int64_t messages = 0;  ///< written
  int damages = 0;       ///< places that are no record
  int64_t damaged_bytes = 0;
};

/// Which part of a log is wanted.
struct LogPart {
  double from = 0;                                      ///< [s] from the first message
  double to = std::numeric_limits<double>::infinity();  ///< [s] from the first message
  std::string channels = ".*";  ///< regular expression that a whole name must match
  std::string excluded;         ///< and must not match; empty: none

  /// True if `utime` lies in [from, to]. `start_utime`: of the log's first message.
  bool holds(int64_t utime, int64_t start_utime) const;
};

/// Copies the wanted part of a log, which by default is every whole record.
/// @throw std::invalid_argument if `path` cannot be read or holds no message, an expression does
///   not parse, or `new_path` exists or cannot be made.
/// @throw std::runtime_error if the disk fails or does not take the copy.
CopyResult copyLog(const std::string& path, const std::string& new_path, const LogPart& part = {});

/// Merges logs by receive time. Messages of one log stay in their order; of two at the same time
/// that of the log named first comes first. Throws as copyLog(), but a log may hold no message; and
/// std::invalid_argument if there is none.
CopyResult mergeLogs(const std::vector<std::string>& paths, const std::string& new_path);

}  // namespace fastball::logger
