#pragma once

#include <cstdint>

namespace fastball::messaging {

/// How many messages are missing between two that follow each other, by their seq; any numbers are safe. A step back is a sender
/// that began again. So is a leap of more than a million, a quarter of an hour at 1 kHz: one forged number must not spoil a count.
inline int64_t missingBetween(int64_t last, int64_t seq) {
  constexpr int64_t kLongestGap = 1'000'000;
  int64_t step = 0;
  if (__builtin_sub_overflow(seq, last, &step) || step < 1 || step > kLongestGap)
    return 0;
  return step - 1;
}

}  // namespace fastball::messaging
