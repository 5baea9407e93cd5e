// Speeds and torques of the arm's joints against their limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "launch/report/joint_shares.h"
#include "launch/report/throw_pictures.h"
#include "launch/report/throw_times.h"

namespace fastball::launch {
namespace {

constexpr double kBefore = 0.15, kAfter = 0.25;  ///< [s], shown beside the swing
constexpr int kPair = model::kArmJoints;         ///< place of the differential's share

/// Columns: time [s], speeds [rad/s], torques [N m], then as shares [%] J1..J4 and the differential, of speed and of torque.
Table tableOf(const ThrowRecord& record,
              const ThrowTimes& times,
              const model::ArmParameters& arm,
              double t_first,
              double t_last) {
  Table table{{"t (s)"}, {}};
  for (const char* quantity : {"speed J{} (rad/s)", "torque J{} (N m)"}) {
    for (int joint = 1; joint <= model::kArmJoints; ++joint)
      table.columns.push_back(fmt::format(fmt::runtime(quantity), joint));
  }
  for (const char* quantity : {"speed", "torque"}) {
    for (const char* name : {"J1", "J2", "J3", "J4", "J2 and J3 together"})
      table.columns.push_back(fmt::format("{} of {} (% of the limit)", quantity, name));
  }
  for (const arm_state_t& state : record.arm) {
    const double t = times.at(state.utime);
    if (t < t_first || t > t_last)
      continue;
    std::vector<double> row{t};
    row.insert(row.end(), state.qd, state.qd + model::kArmJoints);
    row.insert(row.end(), state.tau, state.tau + model::kArmJoints);
    for (const JointShares& shares : {speedShares(arm, state), torqueShares(arm, state)}) {
      for (const double share : shares)
        row.push_back(100 * share);
    }
    table.rows.push_back(row);
  }
  return table;
}

/// gnuplot clauses of five curves that begin in this column.
std::string curves(int first_column, bool differential) {
  std::string plot =
      "plot 100 w l lw 1.5 dt 2 lc rgb '#000000', -100 w l lw 1.5 dt 2 lc rgb '#000000'";
  if (differential)
    plot +=
        fmt::format(", $m u 1:{} w l lw 1.5 lc rgb '#909090' title 'J2+J3'", first_column + kPair);
  for (int joint = 0; joint < model::kArmJoints; ++joint)
    plot += fmt::format(", $m u 1:{} w l lw 2 lc rgb {} title 'J{}'", first_column + joint,
                        kColours[joint], joint + 1);
  return plot + "\n";
}

std::string commandsOf(const ThrowTimes& times, double t_first, double t_last, bool differential) {
  const std::string moments = momentLine(1, times.swing, 1, "swing begins", WordsAt::kMiddle) +
                              momentLine(2, times.departure, 1, "ball leaves", WordsAt::kLeft) +
                              momentLine(3, times.swing_end, 1, "follow-through", WordsAt::kRight);
  return kStyle +
         fmt::format(
             "set multiplot\nset termoption noenhanced\n"
             "set lmargin at screen 0.075; set rmargin at screen 0.985; set xrange "
             "[{:.4f}:{:.4f}]\n"
             "set yrange [-115:115]; set ytics 50\n{}"
             "set tmargin at screen 0.895; set bmargin at screen 0.52\n"
             "set format x ''; set ylabel 'speed (% of the limit)' offset 0.8,0\n"
             "set key at screen 0.985,0.995 top right horizontal samplen 2 maxrows 1\n{}"
             "unset label\nset tmargin at screen 0.48; set bmargin at screen 0.105; set key off\n"
             "set format x '%g'; set xlabel {} offset 0,0.4\n"
             "set ylabel 'torque (% of the limit)' offset 0.8,0\n{}unset multiplot\n",
             t_first, t_last, moments, curves(10, differential),
             quoted("time from " + times.of_origin + " (s)"), curves(15, differential));
}

}  // namespace

std::string drawMotion(const LoggedThrow& thrown,
                       const config::Experiment& experiment,
                       const std::string& path_stem) {
  const ThrowRecord& record = thrown.record;
  if (record.arm.empty())
    throw std::runtime_error("the log has no ARM_STATE");
  const ThrowTimes times = timesOf(record);
  const double first = times.at(record.arm.front().utime), last = times.at(record.arm.back().utime);
  const double t_first = times.swing ? std::max(first, *times.swing - kBefore) : first;
  const double t_last =
      times.swing_end ? std::min(last, std::max(*times.swing_end, 0.0) + kAfter) : last;
  const Table table = tableOf(record, times, experiment.arm, t_first, t_last);
  if (table.rows.size() < 2)
    throw std::runtime_error("the log has no ARM_STATE of the swing");
  writeCsv(table, path_stem + ".csv");
  drawPicture(path_stem, 1000, 560, dataBlock("m", plotData(table)),
              commandsOf(times, t_first, t_last, experiment.arm.differential));
  const JointPeaks peaks = peaksOf(record, experiment.arm);
  const auto nearest = [](const JointShares& shares) {
    return std::max_element(shares.begin(), shares.end()) - shares.begin();
  };
  const auto name = [](std::ptrdiff_t place) {
    return place == kPair ? std::string("J2 and J3 together") : fmt::format("J{}", place + 1);
  };
  const auto speed = nearest(peaks.speed), torque = nearest(peaks.torque);
  return fmt::format(
      "Measured joint speeds and applied torques as shares of the limits of {} (dashed). Nearest "
      "to its limit of speed comes {} with "
      "{:.0f} %, of torque {} with {:.0f} %.{}",
      experiment.arm.profile, name(speed), 100 * peaks.speed[static_cast<std::size_t>(speed)],
      name(torque), 100 * peaks.torque[static_cast<std::size_t>(torque)],
      experiment.arm.differential
          ? " J2 and J3 share their motors: the sum of their shares is limited, too (grey)."
          : "");
}

}  // namespace fastball::launch
