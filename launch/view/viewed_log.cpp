#include "launch/view/viewed_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace fastball::view {
namespace {

/// A page holds so many in memory, some 60 MB: more than that, and every second, third, ... is shown.
constexpr int64_t kMostSamples = 200'000;

TimelineLimits limitsOf(int keep_every) {
  TimelineLimits limits;
  limits.samples = limits.pictures = limits.heartbeats = limits.track_points = limits.throws =
      std::numeric_limits<std::size_t>::max();
  limits.keep_every = keep_every;
  return limits;
}

/// How many states a log holds, of the arm or of the hand, whichever has more.
int64_t stateCount(logger::LogReader& reader) {
  int64_t arm = 0, hand = 0;
  logger::LogEntry entry;
  while (reader.next(entry)) {
    arm += entry.channel == messaging::kArmState.name ? 1 : 0;
    hand += entry.channel == messaging::kHandState.name ? 1 : 0;
  }
  reader.rewind();
  return std::max(arm, hand);
}

}  // namespace

ViewedLog::ViewedLog(const std::string& path, const config::Experiment& experiment, double floor)
    : reader_(path) {
  keep_every_ = static_cast<int>(1 + stateCount(reader_) / kMostSamples);
  timeline_ = std::make_unique<Timeline>(experiment, floor, limitsOf(keep_every_));
  logger::LogEntry entry;
  int64_t messages = 0;
  int damages = 0;  // before the last message
  double first_damage = 0;
  for (int64_t offset = 0; reader_.next(entry); offset = reader_.offset(), ++messages) {
    if (damages == 0 && reader_.damageCount() > 0)
      first_damage = timeline_->now();
    damages = reader_.damageCount();
    timeline_->take(entry.channel, entry.data.data(), entry.data.size(), entry.utime, offset);
  }
  if (messages == 0)
    throw std::invalid_argument(fmt::format("'{}' holds no LCM message", path));
  if (keep_every_ > 1)
    faults_.push_back(fmt::format("The log is long: one in {} states is shown.", keep_every_));
  if (damages > 0)
    faults_.push_back(fmt::format(
        "The log is damaged in {} place{}, the first at {:.2f} s; what is whole is shown.", damages,
        damages == 1 ? "" : "s", first_damage));
  if (reader_.damageCount() > damages)
    faults_.push_back(
        fmt::format("The log is cut at {:.2f} s, in the middle of a message.", timeline_->now()));
}

std::vector<std::string> ViewedLog::faults() const {
  return faults_;
}

std::shared_ptr<const image_t> ViewedLog::image(const Picture& picture) {
  reader_.seek(picture.log_offset);
  logger::LogEntry entry;
  const auto image = std::make_shared<image_t>();
  if (!reader_.next(entry) || !entry.decode(*image))
    return nullptr;
  return image;
}

}  // namespace fastball::view
