#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "messaging/type_library.h"

namespace fastball::logger {

/// True if several processes say this channel, each with a seq of its own, so that a gap means nothing.
bool hasManySenders(const std::string& channel);

/// Watches the sequence numbers of each channel that has one sender, where the messages are of a type that begins with the
/// members utime and seq, as all of this project's do.
class SequenceGaps {
 public:
  /// `types` must live as long.
  explicit SequenceGaps(const messaging::TypeLibrary& types) : types_(types) {}
  /// @return how many messages are missing between this one and the one before on its channel. A step back is a sender that began
  /// again, and is no gap.
  int64_t missingBefore(const std::string& channel, const void* data, std::size_t size);

 private:
  bool hasSeq(const void* data, std::size_t size);
  const messaging::TypeLibrary& types_;
  std::unordered_map<int64_t, bool> has_seq_;  // by fingerprint
  std::unordered_map<std::string, int64_t> last_;
};

}  // namespace fastball::logger
