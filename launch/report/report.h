#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// What became of a report.
struct ReportOutcome {
  bool holds_messages = true;  ///< the log is an LCM log that is not empty
  std::vector<std::string>
      missing;  ///< sentences: what the log lacks, and which pictures are not there for it
};

/// Writes the report of a run into `folder` (made if absent): index.html, its pictures as PNG and SVG (landings,
/// loops, and of each throw throw-1, motion-1, release-1, fingers-1, residuals-1, ...), their numbers as CSV,
/// release-1.txt with the caption, and throws.csv with a line each.
/// @param config experiment file; empty: that recorded beside the log, or else the default one.
/// @throw std::invalid_argument if the log cannot be read.
/// @throw std::runtime_error if the folder cannot be written to.
ReportOutcome writeReport(const std::string& log_path,
                          const std::string& config,
                          const std::string& folder);

}  // namespace fastball::launch
