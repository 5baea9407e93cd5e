#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// One error of an uncertainty file.
struct ErrorLine {
  std::string name;
  std::string drawn_for;     ///< "set-up" or "throw"
  std::string distribution;  ///< "normal, sd 0.002"
  std::string unit, reason;
};

/// @throw std::invalid_argument with a sentence if the file cannot be read.
std::vector<ErrorLine> errorLines(const std::string& path);

/// The errors of an uncertainty file as a table in Markdown: name, part, distribution, unit, reason.
/// @throw std::invalid_argument with a sentence if it cannot be read.
std::string errorTable(const std::string& path);

}  // namespace fastball::launch
