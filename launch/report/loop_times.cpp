#include "launch/report/loop_times.h"

#include <algorithm>

namespace fastball::launch {

LoopTimes loopTimesOf(const LoggedProcess& process) {
  LoopTimes times;
  std::vector<double> means;
  for (const heartbeat_t& beat : process.heartbeats) {
    if (!(beat.loop_mean_us > 0))
      continue;
    means.push_back(beat.loop_mean_us);
    times.worst_us = std::max(times.worst_us, beat.loop_max_us);
  }
  times.beats = static_cast<int>(means.size());
  if (means.empty())
    return times;
  times.largest_mean_us = *std::max_element(means.begin(), means.end());
  const auto middle = means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2);
  std::nth_element(means.begin(), middle, means.end());
  times.median_mean_us = *middle;
  return times;
}

}  // namespace fastball::launch
