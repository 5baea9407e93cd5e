// How long the processes' loops took.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "launch/figures/style.h"
#include "launch/gnuplot.h"
#include "launch/report/loop_times.h"
#include "launch/report/run_pictures.h"

namespace fastball::launch {
namespace {

constexpr int kRow = 34, kRest = 110;  ///< [px]
constexpr double kLeast = 0.1;         ///< [us], where the axis begins at the earliest

}  // namespace

std::string drawLoops(const LoggedRun& run, const std::string& path_stem) {
  std::string data, tics;
  double least = 1e3, most = 1;
  int rows = 0;
  for (const LoggedProcess& process : run.processes) {
    const LoopTimes loops = loopTimesOf(process);
    if (loops.beats == 0)
      continue;
    least = std::min(least, loops.median_mean_us);
    most = std::max(most, loops.worst_us);
    data += fmt::format("{} {} {} {}\n", -rows, loops.median_mean_us, loops.largest_mean_us,
                        loops.worst_us);
    tics += fmt::format("{}{} {}", rows == 0 ? "" : ", ",
                        quoted(process.last().name + " on " + process.last().host), -rows);
    ++rows;
  }
  if (rows == 0)
    throw std::runtime_error("the log has no HEARTBEAT with the time of a loop");
  const int height = kRest + kRow * rows;
  drawPicture(
      path_stem, 1000, height, dataBlock("p", data),
      kStyle +
          fmt::format(
              "set termoption noenhanced\nset lmargin at screen 0.24; set rmargin at screen 0.985\n"
              "set tmargin at screen {0:.4f}; set bmargin at screen {1:.4f}\n"
              "set logscale x; set xrange [{2}:{3}]; set yrange [{4}:0.5]\n"
              "set xlabel 'time of a loop (µs), logarithmic' offset 0,0.4; set ytics ({5}) scale "
              "0\n"
              "set key at screen 0.985,{6:.4f} top right horizontal maxrows 1\n"
              "plot $p u 2:1:2:4 w xerrorbars pt 0 lw 1.5 lc rgb '#909090' notitle, "
              "'' u 2:1 w p pt 7 ps 1.2 lc rgb {7} title 'mean', "
              "'' u 3:1 w p pt 6 ps 1.2 lw 2 lc rgb {7} title 'largest mean', "
              "'' u 4:1 w p pt 9 ps 1.4 lc rgb {8} title 'longest'\n",
              1 - 40.0 / height, 56.0 / height, std::max(kLeast, least / 2), 2 * most, 0.5 - rows,
              tics, 1 - 6.0 / height, kColours[0], kColours[1]));
  return "By the HEARTBEATs of each process: how long one turn of its loop took. Mean: the median "
         "of "
         "the means that it gave once a second; the largest of them; and the longest turn of all.";
}

}  // namespace fastball::launch
