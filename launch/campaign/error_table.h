#pragma once

#include <string>

namespace fastball::launch {

/// The errors of an uncertainty file as a table in Markdown: name, part, distribution, unit, reason.
/// @throw std::invalid_argument with a sentence if it cannot be read.
std::string errorTable(const std::string& path);

}  // namespace fastball::launch
