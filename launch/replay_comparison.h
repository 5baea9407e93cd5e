#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messaging/type_library.h"

namespace fastball::launch {

/// How the messages of one channel compare with the recorded ones.
struct ComparedChannel {
  int64_t recorded = 0;
  int64_t equal = 0;
  int64_t different = 0;
  /// "message 17: tau[2] was 1.5, is 1.25"; empty: none differs.
  std::string first_difference;
  int64_t missing() const { return recorded - equal - different; }
};

/// Pairs recorded messages with those that a process says now, and compares every field but `seq`
/// and `plan_ms`, which depend on the start and the speed of the process. Messages of one channel
/// that name the same tick or frame (of the same scene and camera) belong together, whatever their
/// order; others in the order in which they come.
class MessageComparison {
 public:
  using Bytes = std::vector<char>;
  /// Channel, and which of its messages.
  using Key = std::pair<std::string, std::string>;

  /// @return by what isPending() knows it.
  Key record(const std::string& channel, const Bytes& message);
  void say(const std::string& channel, const Bytes& message);
  /// Recorded messages whose counterpart has not been said.
  std::size_t pending() const { return recorded_.size(); }
  bool isPending(const Key& recorded) const { return recorded_.count(recorded) != 0; }
  /// True if the message names the tick or the frame that it answers.
  bool isAnswer(const Bytes& message) const;
  /// By channel.
  const std::map<std::string, ComparedChannel>& channels() const { return channels_; }

 private:
  struct Recorded {
    int64_t number;
    Bytes bytes;
  };
  Key keyOf(const std::string& channel, const Bytes& message, std::map<Key, int64_t>& counts) const;
  void compare(const std::string& channel, const Recorded& recorded, const Bytes& said);
  std::string difference(const Bytes& recorded, const Bytes& said) const;

  messaging::TypeLibrary types_;
  std::map<Key, Recorded> recorded_;
  std::map<Key, Bytes> said_;
  std::map<Key, int64_t> recorded_counts_, said_counts_;
  std::map<std::string, ComparedChannel> channels_;
};

/// "ARM_COMMAND: 6437 of 6438 equal, 1 different, first message 17: tau[2] was 1.5, is 1.25"
std::string comparisonLine(const std::string& name, const ComparedChannel& channel);

}  // namespace fastball::launch
