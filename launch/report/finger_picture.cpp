// Forces of the fingers on the ball around its release.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "launch/report/throw_pictures.h"
#include "launch/report/throw_times.h"
#include "model/hand_parameters.h"

namespace fastball::launch {
namespace {

constexpr double kShown = 0.06;  ///< [s], before and after the departure
constexpr const char* kNames[] = {"finger A", "thumb", "finger B"};

Table tableOf(const ThrowRecord& record, const ThrowTimes& times) {
  Table table{{"t from departure (ms)"}, {}};
  for (const char* force : {"normal", "tangential"}) {
    for (const char* name : kNames)
      table.columns.push_back(fmt::format("{} {} (N)", name, force));
  }
  for (const hand_state_t& state : record.hand) {
    const double t = times.at(state.utime);
    if (std::abs(t) > kShown)
      continue;
    std::vector<double> row{1e3 * t};
    row.insert(row.end(), state.f_normal, state.f_normal + model::kFingers);
    for (const auto& f : state.f_tangential)
      row.push_back(std::hypot(f[0], f[1]));
    table.rows.push_back(row);
  }
  return table;
}

std::string curves(int first_column) {
  // A and B stand behind the ball side by side: where their curves are one, both are seen.
  constexpr double kWidths[] = {4.5, 2.5, 1.5};
  std::string plot;
  for (int finger = 0; finger < model::kFingers; ++finger)
    plot += fmt::format("{} $f u 1:{} w l lw {} lc rgb {} title '{}'", plot.empty() ? "plot" : ",",
                        first_column + finger, kWidths[finger], kColours[finger], kNames[finger]);
  return plot + "\n";
}

/// The window in which the ball may leave, in grey.
std::string windowBox(const ThrowTimes& times) {
  if (!times.window[0] || !times.window[1])
    return "";
  return fmt::format(
      "set object 1 rectangle from {:.3f}, graph 0 to {:.3f}, graph 1 behind fs solid 1 noborder "
      "fc "
      "rgb '#eef1f4'\n",
      1e3 * std::max(*times.window[0], -kShown), 1e3 * std::min(*times.window[1], kShown));
}

std::string commandsOf(const ThrowTimes& times) {
  return kStyle +
         fmt::format(
             "set multiplot\nset termoption noenhanced\nset xrange [{0}:{1}]; set yrange [0:*]\n"
             "set offsets graph 0, graph 0, graph 0.05, graph 0\n"
             "set tmargin at screen 0.9; set bmargin at screen 0.21\n{2}{3}{4}"
             "set xlabel {5} offset 0,0.4\n"
             "set lmargin at screen 0.065; set rmargin at screen 0.49\n"
             "set ylabel 'normal force (N)' offset 1,0\n"
             "set key at graph 0.985,0.97 top right vertical samplen 2.5\n{6}"
             "set lmargin at screen 0.575; set rmargin at screen 0.985; set key off\n"
             "set ylabel 'tangential force (N)' offset 1,0\n{7}unset multiplot\n",
             -1e3 * kShown, 1e3 * kShown, windowBox(times),
             momentLine(1, times.command, 1e3, "told to let go", WordsAt::kLeft),
             momentLine(2, times.departure, 1e3, "ball leaves", WordsAt::kRight),
             quoted("time from " + times.of_origin + " (ms)"), curves(2), curves(5));
}

}  // namespace

std::string drawFingers(const LoggedThrow& thrown, const std::string& path_stem) {
  const ThrowRecord& record = thrown.record;
  if (record.hand.empty())
    throw std::runtime_error("the log has no HAND_STATE");
  const ThrowTimes times = timesOf(record);
  if (!times.departure && !times.window[0])
    throw std::runtime_error("the log has no RELEASE of the ball's departure, and no plan");
  const Table table = tableOf(record, times);
  if (table.rows.size() < 2)
    throw std::runtime_error("the log has no HAND_STATE around the release");
  writeCsv(table, path_stem + ".csv");
  drawPicture(path_stem, 1000, 270, dataBlock("f", plotData(table)), commandsOf(times));
  std::string caption = "Forces of the fingers on the ball, as they feel them.";
  if (times.window[0])
    caption += " Shaded: the time in which the ball may leave, by the plan.";
  if (record.commanded)
    caption += fmt::format(" When the hand was told to let go the thumb pressed with {:.2f} N.",
                           record.commanded->f_normal[model::kThumb]);
  return caption;
}

}  // namespace fastball::launch
