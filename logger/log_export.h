#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "logger/log_edit.h"
#include "messaging/type_library.h"

namespace fastball::logger {

struct ExportOptions {
  std::string channel;
  /// Names of values ("q[0]") or of whole members ("q"), in the order of the columns; empty: all.
  std::vector<std::string> fields;
  double from = 0;                                      ///< [s] from the log's first message
  double to = std::numeric_limits<double>::infinity();  ///< [s] from the log's first message
};

struct ExportResult {
  int64_t messages = 0;
  int64_t undecodable = 0;  ///< passed over
};

/// Writes the messages of one channel as CSV: a header, then a line for each message with the receive time `recv_utime` [us since
/// 1970] and its values, numbers with the shortest digits that give them back exactly. Where an array is shorter
/// than in another message, its columns are empty.
/// @throw std::invalid_argument if the log cannot be read, has no decodable message on that
///   channel, has no such field, or has more than 10 000 values in a message, too many for a table;
///   the sentence names what there is. Whether `csv` took it all is for the caller to look.
ExportResult exportCsv(const std::string& path,
                       const ExportOptions& options,
                       const messaging::TypeLibrary& types,
                       std::ostream& csv);

}  // namespace fastball::logger
