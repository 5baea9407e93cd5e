#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace fastball::messaging {

/// What a key kept out, channel by channel, in words.
class Refusals {
 public:
  /// Writes a line to the log and renews the sentence. `count`: how many of the channel so far; `what`: of the newest, such as
  /// "has no tag".
  void tell(const std::string& channel, int64_t count, const std::string& what);
  /// "refused 4 ARM_COMMANDs; the first has no tag; refused 1 SCENE; the first ...", or empty.
  const std::string& sentence() const { return sentence_; }

 private:
  struct Channel {
    int64_t count = 0;
    std::string first;
  };
  std::map<std::string, Channel> channels_;
  std::string sentence_;
};

}  // namespace fastball::messaging
