#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "messaging/type_library.h"

namespace fastball::launch {

/// What a message type says about every message of it, so that a message can be judged without being walked over.
struct MessageLayout {
  std::optional<std::size_t> bytes;  ///< of every encoded message; none: they differ
  /// Where the integer member `seq` stands in every encoded message, none: it has none, or not always at one place.
  std::optional<std::size_t> seq_offset;
  std::size_t seq_bytes = 0;  ///< 4 or 8

  /// Its sequence number, or nothing.
  std::optional<int64_t> seq(const void* data, std::size_t size) const;
};

MessageLayout layoutOf(const messaging::TypeLibrary& types,
                       const messaging::TypeLibrary::Type& type);

}  // namespace fastball::launch
