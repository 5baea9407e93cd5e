#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace fastball::launch {

/// When the messages of one channel came in the last two seconds, in memory that does not grow with their number. Times are
/// [us since 1970] of one clock.
class ArrivalWindow {
 public:
  /// `utime` may be a little before that of the message before; after a step back of more than the window all is forgotten.
  void take(int64_t utime, std::size_t bytes);

  /// [Hz] of the messages in the window. A channel slower than that has the rate of its last gap, and 0 once it is silent for
  /// twice that gap.
  double rate(int64_t now) const;
  /// [bytes/s]
  double bandwidth(int64_t now) const;
  /// [s] standard deviation of the gaps between messages; none with fewer than two gaps in the window.
  std::optional<double> jitter(int64_t now) const;

 private:
  static constexpr int64_t kSlotUs = 100'000;
  static constexpr int64_t kSlots = 20;
  /// The gaps that ended in one tenth of a second.
  struct Slot {
    int64_t index = INT64_MIN;  ///< time / kSlotUs
    int64_t gaps = 0;
    double bytes = 0;
    double sum = 0;         ///< [us]
    double square_sum = 0;  ///< [us^2]
  };
  Slot inWindow(int64_t now) const;

  std::array<Slot, kSlots> slots_{};
  int64_t last_utime_ = INT64_MIN;
  int64_t last_gap_ = 0;  ///< [us], 0: none yet
  double last_bytes_ = 0;
};

}  // namespace fastball::launch
