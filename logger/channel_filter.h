#pragma once

#include <regex>
#include <string>
#include <unordered_map>

namespace fastball::logger {

/// Which channels are wanted, by regular expressions (ECMAScript's) that match the whole name. It
/// remembers its answers: for one thread only.
class ChannelFilter {
 public:
  /// `excluded` empty: none. @throw std::invalid_argument if an expression does not parse; names it.
  ChannelFilter(const std::string& wanted, const std::string& excluded);
  bool wants(const std::string& channel);

 private:
  std::regex wanted_, excluded_;
  bool excludes_;
  std::unordered_map<std::string, bool> known_;
};

}  // namespace fastball::logger
