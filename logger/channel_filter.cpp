#include "logger/channel_filter.h"

#include <fmt/format.h>

#include <stdexcept>

namespace fastball::logger {
namespace {

/// Names are for whoever sends: many of them must not fill the memory.
constexpr std::size_t kMaxKnown = 10000;

std::regex parsed(const std::string& expression) {
  try {
    return std::regex(expression, std::regex::ECMAScript | std::regex::optimize);
  } catch (const std::regex_error& error) {
    throw std::invalid_argument(
        fmt::format("'{}' is no regular expression for channels: {}", expression, error.what()));
  }
}

}  // namespace

ChannelFilter::ChannelFilter(const std::string& wanted, const std::string& excluded)
    : wanted_(parsed(wanted)), excluded_(parsed(excluded)), excludes_(!excluded.empty()) {}

bool ChannelFilter::wants(const std::string& channel) {
  const auto found = known_.find(channel);
  if (found != known_.end())
    return found->second;
  const bool wanted =
      std::regex_match(channel, wanted_) && !(excludes_ && std::regex_match(channel, excluded_));
  if (known_.size() < kMaxKnown)
    known_.emplace(channel, wanted);
  return wanted;
}

}  // namespace fastball::logger
