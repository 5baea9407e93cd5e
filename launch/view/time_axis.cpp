#include "launch/view/time_axis.h"

#include <algorithm>

namespace fastball::view {

void TimeAxis::receive(int64_t utime) {
  if (first_receipt_ < 0)
    first_receipt_ = utime;
  if (scenes_ == 0)
    now_ = std::max(now_, 1e-6 * static_cast<double>(utime - first_receipt_));
}

void TimeAxis::state(int64_t scene_id, int64_t utime) {
  if (scenes_ == 0 || scene_id != scene_id_ || utime < newest_ - kOvertakenUs) {
    if (scenes_ > 0)
      now_ += kBetweenScenes;
    ++scenes_;
    scene_id_ = scene_id;
    offset_ = now_ - 1e-6 * static_cast<double>(utime);
    newest_ = utime;
  }
  newest_ = std::max(newest_, utime);
  now_ = std::max(now_, at(utime));
}

}  // namespace fastball::view
