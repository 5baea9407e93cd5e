#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "bench/plan_cost.h"
#include "launch/figures/figure.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/gnuplot.h"
#include "planner/atlas_builder.h"
#include "planner/config.h"

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;
// [m] between the nodes of the atlases that are built.
constexpr double kSteps[] = {0.8, 0.4, 0.2};

Table solveTable(const std::string& what,
                 const std::vector<bench::SolveCost>& costs,
                 int bench::SolveCost::*growing) {
  Table table{{what, "exact gradients (ms)", "finite differences (ms)"}, {}};
  for (const bench::SolveCost& cost : costs) {
    table.rows.push_back({static_cast<double>(cost.*growing), kMilli * cost.planner_seconds,
                          kMilli * cost.differences_seconds});
  }
  return table;
}

Table atlasTable(planner::PlannerConfig config, int threads) {
  Table table{{"nodes", "build (s)"}, {}};
  for (const double step : kSteps) {
    config.atlas.step = step;
    const auto begin = std::chrono::steady_clock::now();
    const planner::Atlas atlas = planner::buildAtlas(config, threads);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    table.rows.push_back({static_cast<double>(atlas.grid().nodes()), taken.count()});
  }
  return table;
}

/// Exponent of the power law through the first and the last row.
double growth(const Table& table, int column) {
  const std::vector<double>&first = table.rows.front(), &last = table.rows.back();
  return std::log(last[column] / first[column]) / std::log(last[0] / first[0]);
}

}  // namespace

std::string drawPlanCost(const FigureTask& task) {
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Table samples = solveTable("samples", bench::costBySamples(), &bench::SolveCost::samples);
  const auto parametersOf = [](planner::Shoulder shoulder) {
    return solveTable("parameters", bench::costByParameters(shoulder),
                      &bench::SolveCost::parameters);
  };
  const Table held = parametersOf(planner::Shoulder::kHeld),
              free = parametersOf(planner::Shoulder::kFree);
  const Table atlas = atlasTable(planner::loadConfig(task.config), threads);
  const std::string stem = task.folder + "/fig_cost";
  writeCsv(samples, stem + "-samples.csv");
  writeCsv(held, stem + "-parameters-held.csv");
  writeCsv(free, stem + "-parameters-free.csv");
  writeCsv(atlas, stem + "-atlas.csv");
  const std::string commands = kStyle + fmt::format(
                                            R"(set multiplot layout 1,3
set logscale xy
set xrange [20:300]; set yrange [1:5000]; set key top left
set title 'One solve by the samples at which limits are looked at'; set xlabel 'samples'; set ylabel 'time (ms)'
plot $s u 1:3 w lp pt 5 lw 2 lc rgb {1} title 'finite differences', $s u 1:2 w lp pt 7 lw 2 lc rgb {0} title 'exact gradients'
set title 'One solve by its free parameters'; set xlabel 'parameters'; unset logscale x; set xrange [9:20]; set xtics 2; set yrange [0.3:5000]
plot $f u 1:3 w lp pt 5 lw 2 dt 2 lc rgb {1} title 'finite differences, joint 2 free', $h u 1:3 w lp pt 5 lw 2 lc rgb {1} title 'finite differences, joint 2 held', \
  $f u 1:2 w lp pt 7 lw 2 dt 2 lc rgb {0} title 'exact gradients, joint 2 free', $h u 1:2 w lp pt 7 lw 2 lc rgb {0} title 'exact gradients, joint 2 held'
set title 'Atlas by its size, {2} threads'; set xlabel 'nodes'; set logscale x; set xrange [5:200]; set ylabel 'time (s)'; set xtics autofreq; set yrange [0.5:50]; unset key
plot $a u 1:2 w lp pt 9 lw 2 lc rgb {0} title 'build'
unset multiplot
)",
                                            kColours[0], kColours[1], threads);
  drawPicture(stem, 1500, 520,
              dataBlock("s", plotData(samples)) + dataBlock("h", plotData(held)) +
                  dataBlock("f", plotData(free)) + dataBlock("a", plotData(atlas)),
              commands);
  return fmt::format(
      "What planning costs on this machine (CPU time; of the atlas wall time). With exact "
      "gradients a solve of Eq. (15) takes {:.1f} ms with {:.0f} samples and {:.1f} ms with "
      "{:.0f}: the time grows as their power {:.1f}. The same problem with NLopt and finite "
      "differences takes {:.0f} to {:.0f} ms (power {:.1f}). A throw beside a solved one, joint 2 "
      "held, takes {:.1f} ms with {:.0f} free parameters and {:.1f} ms with {:.0f}. An atlas of "
      "{:.0f} nodes "
      "is built in {:.1f} s, one of {:.0f} in {:.1f} s: as the power "
      "{:.1f} of its size.",
      samples.rows.front()[1], samples.rows.front()[0], samples.rows.back()[1],
      samples.rows.back()[0], growth(samples, 1), samples.rows.front()[2], samples.rows.back()[2],
      growth(samples, 2), held.rows.front()[1], held.rows.front()[0], held.rows.back()[1],
      held.rows.back()[0], atlas.rows.front()[0], atlas.rows.front()[1], atlas.rows.back()[0],
      atlas.rows.back()[1], growth(atlas, 1));
}

}  // namespace fastball::launch
