#pragma once

#include <string>

namespace fastball::launch {

/// The text as UTF-8 that can be shown: what is none, and control characters other than line feed and tab, become U+FFFD.
std::string cleanText(const std::string& text);

}  // namespace fastball::launch
