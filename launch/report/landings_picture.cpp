// All landings of a run, measured and true.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "launch/report/run_pictures.h"
#include "launch/report/target_face.h"

namespace fastball::launch {
namespace {

constexpr double kDeviations = 1.96;  ///< of a normal distribution, hold 95 %

/// Columns: number, measured right, up, half of their 95 % intervals, true right, up [mm].
Table tableOf(const LoggedRun& run) {
  Table table{{"throw", "measured right (mm)", "measured up (mm)", "half 95 % interval right (mm)",
               "half 95 % interval up (mm)", "true right (mm)", "true up (mm)"},
              {}};
  for (const auto& [number, thrown] : run.throws) {
    std::vector<double> row(7, kNoNumber);
    row[0] = static_cast<double>(number);
    if (thrown.isMeasured()) {
      const landing_t& landing = *thrown.record.landing;
      row[1] = 1e3 * landing.landing[0];
      row[2] = 1e3 * landing.landing[1];
      row[3] = 1e3 * kDeviations * std::sqrt(std::max(0.0, landing.cov_landing[0]));
      row[4] = 1e3 * kDeviations * std::sqrt(std::max(0.0, landing.cov_landing[2]));
    }
    if (thrown.truth.landing) {
      row[5] = 1e3 * thrown.truth.landing->x();
      row[6] = 1e3 * thrown.truth.landing->y();
    }
    table.rows.push_back(row);
  }
  return table;
}

/// Ring, ring for the whole ball, and all ellipses.
std::string outlinesOf(const LoggedRun& run, double ring_mm, double ball_mm) {
  std::string rings, ellipses;
  for (const double radius : {ring_mm, std::max(ring_mm - ball_mm, 0.0)}) {
    for (int i = 0; i <= 72; ++i)
      rings += fmt::format("{:.3f} {:.3f}\n", radius * std::cos(i * M_PI / 36),
                           radius * std::sin(i * M_PI / 36));
    rings += "\n\n";
  }
  for (const auto& [number, thrown] : run.throws) {
    if (thrown.isMeasured())
      ellipses += ellipse95(*thrown.record.landing) + "\n";
  }
  return dataBlock("rings", rings) +
         dataBlock("ellipses", ellipses.empty() ? "NaN NaN\n" : ellipses);
}

double farthest(const Table& table, double ring_mm) {
  double most = ring_mm;
  for (const std::vector<double>& row : table.rows) {
    for (const std::size_t column : {1, 2, 5, 6}) {
      if (std::isfinite(row[column]))
        most = std::max(most, std::abs(row[column]));
    }
  }
  return most;
}

std::string commandsOf(const Table& table, double half_width) {
  const double first = table.rows.front()[0] - 0.6, last = table.rows.back()[0] + 0.6;
  const bool few = table.rows.size() <= 20;
  const std::string strip =
      "plot $l u 1:{}:{} w yerrorbars pt 1 ps 0.9 lw 2 lc rgb {} title 'measured, 95 % interval', "
      "$l u 1:{} w p pt 6 ps 1.1 lw 2 lc rgb '#000000' title 'true'\n";
  return kStyle +
         fmt::format(
             "set termoption noenhanced\nset multiplot\n"
             "set lmargin at screen 0.08; set rmargin at screen 0.43\n"
             "set tmargin at screen 0.925; set bmargin at screen 0.125\n"
             "set xrange [-{0}:{0}]; set yrange [-{0}:{0}]; set key off\n"
             "set title 'The net, seen from the robot' offset 0,-0.6\n"
             "set xlabel 'right (mm)' offset 0,0.4; set ylabel 'up (mm)' offset 1,0\n"
             "plot $rings index 0 w l lw 3 lc rgb '#222222', $rings index 1 w l lw 1.5 dt 2 lc rgb "
             "'#222222', $ellipses w l lw 1.5 lc rgb {1}, $l u 2:3 w p pt 1 ps 1 lw 2 lc rgb {1}, "
             "$l u 6:7 w p pt 6 ps 1 lw 1.5 lc rgb '#000000'\n"
             "set lmargin at screen 0.53; set rmargin at screen 0.985; unset title\n"
             "set xrange [{2}:{3}]; set yrange [*:*]; {4}\n"
             "set offsets graph 0, graph 0, graph 0.1, graph 0.1\n"
             "set tmargin at screen 0.925; set bmargin at screen 0.56; set format x ''; unset "
             "xlabel\n"
             "set ylabel 'right (mm)'; set key at screen 0.985,0.995 top right horizontal\n{5}"
             "set tmargin at screen 0.49; set bmargin at screen 0.125; set format x '%g'; set key "
             "off\n"
             "set xlabel 'throw' offset 0,0.4; set ylabel 'up (mm)'\n{6}unset multiplot\n",
             half_width, kColours[1], first, last, few ? "set xtics 1" : "set xtics autofreq",
             fmt::format(fmt::runtime(strip), 2, 4, kColours[1], 6),
             fmt::format(fmt::runtime(strip), 3, 5, kColours[1], 7));
}

}  // namespace

std::string drawRunLandings(const LoggedRun& run,
                            const config::Experiment& experiment,
                            const std::string& path_stem) {
  const Table table = tableOf(run);
  const bool any = std::any_of(table.rows.begin(), table.rows.end(), [](const auto& row) {
    return std::isfinite(row[1]) || std::isfinite(row[5]);
  });
  if (!any)
    throw std::runtime_error("the log has no LANDING that was measured, and no true one");
  const double ring_mm = 1e3 * targetOf(run.throws.begin()->second, experiment).radius;
  writeCsv(table, path_stem + ".csv");
  drawPicture(
      path_stem, 1000, 440,
      dataBlock("l", plotData(table)) + outlinesOf(run, ring_mm, 1e3 * experiment.ball.radius),
      commandsOf(table, 1.2 * farthest(table, ring_mm)));
  return "Left: all landings in the ring; within the dashed circle the whole ball passes. Crosses "
         "are "
         "measured, with their 95 % ellipses; circles are true. Right: the same for each throw.";
}

}  // namespace fastball::launch
