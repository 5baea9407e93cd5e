#include "launch/spy/arrival_window.h"

#include <algorithm>
#include <cmath>

namespace fastball::launch {
namespace {

constexpr double kSeconds = 1e-6;

}  // namespace

void ArrivalWindow::take(int64_t utime, std::size_t bytes) {
  const bool is_first = last_utime_ == INT64_MIN || utime < last_utime_ - kSlots * kSlotUs;
  if (is_first) {
    slots_ = {};
    last_gap_ = 0;
  } else {
    const int64_t index = std::max(utime, last_utime_) / kSlotUs;
    Slot& slot = slots_[static_cast<std::size_t>(index % kSlots)];
    if (slot.index != index)
      slot = {index, 0, 0, 0, 0};
    // The kernel's times of arrival step back a little on a busy machine: such a gap is negative.
    const auto gap = static_cast<double>(utime - last_utime_);
    ++slot.gaps;
    slot.bytes += static_cast<double>(bytes);
    slot.sum += gap;
    slot.square_sum += gap * gap;
    last_gap_ = std::max<int64_t>(utime - last_utime_, 1);
  }
  last_utime_ = utime;
  last_bytes_ = static_cast<double>(bytes);
}

ArrivalWindow::Slot ArrivalWindow::inWindow(int64_t now) const {
  const int64_t newest = std::max(now, last_utime_) / kSlotUs;
  Slot all;
  for (const Slot& slot : slots_) {
    if (slot.gaps == 0 || slot.index <= newest - kSlots)
      continue;
    all.gaps += slot.gaps;
    all.bytes += slot.bytes;
    all.sum += slot.sum;
    all.square_sum += slot.square_sum;
  }
  return all;
}

double ArrivalWindow::rate(int64_t now) const {
  if (last_gap_ == 0)
    return 0;
  const auto silence = static_cast<double>(std::max<int64_t>(now - last_utime_, 0));
  const Slot all = inWindow(now);
  if (all.gaps == 0) {
    const auto gap = static_cast<double>(last_gap_);
    return silence > 2 * gap ? 0 : 1 / (kSeconds * std::max(gap, silence));
  }
  // A silence longer than a gap is part of what the messages took.
  const auto gaps = static_cast<double>(all.gaps);
  const double mean_gap = std::max(all.sum / gaps, 1.0);
  return gaps / (kSeconds * (gaps * mean_gap + std::max(silence - mean_gap, 0.0)));
}

double ArrivalWindow::bandwidth(int64_t now) const {
  const Slot all = inWindow(now);
  return rate(now) * (all.gaps == 0 ? last_bytes_ : all.bytes / static_cast<double>(all.gaps));
}

std::optional<double> ArrivalWindow::jitter(int64_t now) const {
  const Slot all = inWindow(now);
  if (all.gaps < 2)
    return std::nullopt;
  const auto gaps = static_cast<double>(all.gaps);
  const double mean = all.sum / gaps;
  const double variance = (all.square_sum - gaps * mean * mean) / (gaps - 1);
  return kSeconds * std::sqrt(std::max(variance, 0.0));
}

}  // namespace fastball::launch
