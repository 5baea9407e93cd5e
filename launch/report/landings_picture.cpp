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

/// One coordinate over the number of the throw. @param column of the measured one; 2: right, 3: up.
std::string stripPlot(const Table& table, std::size_t column) {
  double least = INFINITY, most = -INFINITY;
  for (const std::vector<double>& row : table.rows) {
    const double measured = row[column - 1], half = row[column + 1], truth = row[column + 3];
    least = std::fmin(std::fmin(least, measured - half), truth);
    most = std::fmax(std::fmax(most, measured + half), truth);
  }
  const double size = std::max(most - least, 0.1);
  return fmt::format(
      "set yrange [{0:.4f}:{1:.4f}]; set ytics {2:g}\n"
      "plot $l u 1:{3}:{4} w yerrorbars pt 7 ps 0.9 lw 2 lc rgb {5} title 'measured, 95 %', $l u "
      "1:{6} w p pt 2 ps 1.2 lw 2 lc rgb '#000000' title 'true'\n",
      least - 0.1 * size, most + 0.1 * size, roundStep(size / 4), column, column + 2, kColours[1],
      column + 4);
}

std::string commandsOf(const Table& table, double half_width) {
  const double first = table.rows.front()[0] - 0.6, last = table.rows.back()[0] + 0.6;
  return kStyle +
         fmt::format(
             "set termoption noenhanced\nset multiplot\n"
             "set lmargin at screen 0.07; set rmargin at screen 0.42\n"
             "set tmargin at screen 0.92; set bmargin at screen 0.125\n"
             "set xrange [-{0}:{0}]; set yrange [-{0}:{0}]; set xtics {1:g}; set ytics {1:g}\n"
             "set title 'The net, seen from the robot' offset 0,-0.6; set key off\n"
             "set xlabel 'right (mm)' offset 0,0.4; set ylabel 'up (mm)' offset 1,0\n"
             "plot $rings index 0 w l lw 3 lc rgb '#222222', $rings index 1 w l lw 1.5 dt 2 lc rgb "
             "'#222222', $ellipses w l lw 1.5 lc rgb {2}, $l u 2:3 w p pt 7 ps 0.6 lc rgb {2}, "
             "$l u 6:7 w p pt 2 ps 0.8 lw 1.5 lc rgb '#000000'\n"
             "set lmargin at screen 0.55; set rmargin at screen 0.985; unset title\n"
             "set xrange [{3}:{4}]; set xtics {5:g}\n"
             "set tmargin at screen 0.92; set bmargin at screen 0.555; set format x ''\n"
             "set key at screen 0.985,0.995 top right horizontal maxrows 1; unset xlabel\n"
             "set ylabel 'right (mm)' offset -0.5,0\n{6}"
             "set tmargin at screen 0.49; set bmargin at screen 0.125; set format x '%g'\n"
             "set key off; set xlabel 'throw' offset 0,0.4; set ylabel 'up (mm)' offset -0.5,0\n{7}"
             "unset multiplot\n",
             half_width, roundStep(half_width / 2.5), kColours[1], first, last,
             std::max(1.0, roundStep((last - first) / 20)), stripPlot(table, 2),
             stripPlot(table, 3));
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
  return "Left: all landings in the ring; the whole ball passes if its centre is within the dashed "
         "circle. Orange: measured, with 95 % ellipses; black crosses: true. Right: the same for "
         "each "
         "throw.";
}

}  // namespace fastball::launch
