#include "launch/report/throw_times.h"

#include <fmt/format.h>

#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/gnuplot.h"

namespace fastball::launch {
namespace {

int64_t microseconds(double seconds) {
  return static_cast<int64_t>(1e6 * seconds);
}

void findOrigin(const ThrowRecord& record, ThrowTimes& times) {
  if (record.departed) {
    times.origin = record.departed->utime;
    times.of_origin = "the ball's departure";
  } else if (record.start && record.plan) {
    times.origin = record.start->start_utime + microseconds(record.plan->t_release);
    times.of_origin = "the planned release";
  } else if (!record.arm.empty() || !record.hand.empty()) {
    times.origin = record.arm.empty() ? record.hand.front().utime : record.arm.front().utime;
    times.of_origin = "the first recorded state";
  } else {
    throw std::runtime_error("the log has no ARM_STATE and no HAND_STATE");
  }
}

}  // namespace

ThrowTimes timesOf(const ThrowRecord& record) {
  ThrowTimes times;
  findOrigin(record, times);
  if (record.departed)
    times.departure = times.at(record.departed->utime);
  if (record.commanded)
    times.command = times.at(record.commanded->utime);
  if (record.start && record.plan) {
    const double start = times.at(record.start->start_utime);
    times.swing = start + record.plan->t_swing;
    times.swing_end = start + record.plan->t_swing_end;
    for (int i = 0; i < 2; ++i)
      times.window[i] = start + record.plan->release_window[i];
  }
  return times;
}

std::string momentLine(int number,
                       const std::optional<double>& t,
                       double scale,
                       const std::string& words,
                       WordsAt side) {
  if (!t)
    return fmt::format("unset arrow {0}; unset label {0}\n", number);
  const char* alignment = side == WordsAt::kLeft     ? "right offset 0.3,0.6"
                          : side == WordsAt::kMiddle ? "center offset 0,0.6"
                                                     : "left offset -0.3,0.6";
  return fmt::format(
      "set arrow {0} from {1:.5f}, graph 0 to {1:.5f}, graph 1 nohead lw 1.5 lc rgb {2} back\n"
      "set label {0} {3} at {1:.5f}, graph 1 {4} tc rgb {2} font ',10'\n",
      number, scale * *t, kGrey, quoted(words), alignment);
}

}  // namespace fastball::launch
