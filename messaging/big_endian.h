#pragma once

#include <cstdint>
#include <string_view>

namespace fastball::messaging {

/// The number that at most eight bytes are, the most significant first, as LCM writes numbers into
/// messages and logs.
inline uint64_t bigEndian(std::string_view bytes) {
  uint64_t value = 0;
  for (const char byte : bytes)
    value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

}  // namespace fastball::messaging
