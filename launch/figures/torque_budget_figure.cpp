#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <future>

#include "bench/ceiling.h"
#include "launch/figures/figure.h"
#include "launch/figures/style.h"
#include "launch/figures/table.h"
#include "launch/figures/torque_budget.h"
#include "launch/gnuplot.h"
#include "planner/config.h"

namespace fastball::launch {
namespace {

const std::vector<double> kShares = {0.1, 0.2, 0.3, 0.4, 0.6, 1.0};
constexpr int kStarts = 12;
constexpr int kFreeStarts = 3;  // of the free-form optimiser, for each share
constexpr int64_t kSeed = 1;
constexpr double kOmegaMax = 12;  // [rad/s]: base functions of a quarter of a second

/// Release speeds [m/s] by share.
using Speeds = std::vector<double>;

Speeds withBaseFunctions(const model::Arm& arm, const BudgetSettings& settings, Timing timing) {
  Speeds speeds;
  for (const BudgetPoint& point : fastestByBudget(arm, settings, timing, kShares, kStarts, kSeed))
    speeds.push_back(point.release_speed > 0 ? point.release_speed : kNoNumber);
  return speeds;
}

struct FreeForm {
  Speeds speeds;
  double bound = 0;  ///< [m/s], by the limits of speed alone
};

FreeForm freeForm(const planner::PlannerConfig& config,
                  const model::Target& target,
                  bool hold_shoulder) {
  bench::CeilingOptions options;
  options.hold_shoulder = hold_shoulder;
  options.must_land = false;
  options.starts = kFreeStarts;
  options.seed = kSeed;
  FreeForm result;
  for (const bench::Ceiling& best :
       bench::ceilingOverTorqueBudget(config, target, options, kShares)) {
    result.speeds.push_back(best.found ? best.release_speed : kNoNumber);
    result.bound = best.bound;
  }
  return result;
}

struct Curves {
  Speeds chain, held, free;
  FreeForm held_ceiling, free_ceiling;
};

Curves compute(const FigureTask& task) {
  const planner::PlannerConfig config = planner::loadConfig(task.config);
  const model::Arm arm(task.experiment.arm, task.experiment.hand.payload);
  const BudgetSettings settings{task.experiment.hand.p_HBall, kOmegaMax, config.swing.elbow_margin,
                                config.swing.body_clearance, config.swing.lowest_ball};
  const auto ceiling = [&](bool hold) {
    return std::async(std::launch::async, freeForm, std::cref(config),
                      std::cref(task.experiment.target), hold);
  };
  auto held_ceiling = ceiling(true), free_ceiling = ceiling(false);
  Curves curves;
  curves.chain = withBaseFunctions(arm, settings, Timing::kKineticChain);
  curves.held = withBaseFunctions(arm, settings, Timing::kInPhaseHeld);
  curves.free = withBaseFunctions(arm, settings, Timing::kInPhaseFree);
  curves.held_ceiling = held_ceiling.get();
  curves.free_ceiling = free_ceiling.get();
  // A throw with joint 2 at rest is one of those that may use it.
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    curves.free[i] = std::fmax(curves.free[i], curves.held[i]);
    curves.free_ceiling.speeds[i] =
        std::fmax(curves.free_ceiling.speeds[i], curves.held_ceiling.speeds[i]);
  }
  return curves;
}

/// Up to which share one is faster than the other, as a sentence.
std::string fasterUpTo(const Speeds& one, const Speeds& other) {
  std::size_t n = 0;
  while (n < kShares.size() && one[n] > other[n])
    ++n;
  if (n == 0)
    return "The chain is not the faster of the two where torque is scarcest. ";
  return fmt::format("The chain is the faster of the two up to {:.0f} % of the torque. ",
                     100 * kShares[n - 1]);
}

/// "+14, +8, +2, -2".
std::string gains(const Speeds& one, const Speeds& other) {
  std::string text;
  for (std::size_t i = 0; i < kShares.size(); ++i)
    text += fmt::format("{}{:+.0f}", text.empty() ? "" : ", ", 100 * (one[i] / other[i] - 1));
  return text;
}

std::string captionOf(const std::string& profile, const Curves& c) {
  std::string shares;
  for (const double share : kShares)
    shares += fmt::format("{}{:.0f}", shares.empty() ? "" : ", ", 100 * share);
  return fmt::format(
             "Fastest release found, wherever the ball flies, of the arm {} within its ranges and "
             "speed limits and {} % of its torque "
             "limits (gravity, drives and friction included). ",
             profile, shares) +
         fmt::format(
             "With joint 2 held, the kinetic chain differs from the same joints in phase by {} %, "
             "and from the free-form optimum by {} %. ",
             gains(c.chain, c.held), gains(c.chain, c.held_ceiling.speeds)) +
         fasterUpTo(c.chain, c.held) +
         fmt::format(
             "The speed limits alone would allow {:.2f} m/s with joint 2 held and "
             "{:.2f} m/s with all joints: with all the torque the chain reaches {:.2f}, the joints "
             "in phase {:.2f} and "
             "{:.2f}, the free form {:.2f} and {:.2f} m/s.",
             c.held_ceiling.bound, c.free_ceiling.bound, c.chain.back(), c.held.back(),
             c.free.back(), c.held_ceiling.speeds.back(), c.free_ceiling.speeds.back());
}

}  // namespace

std::string drawTorqueBudget(const FigureTask& task) {
  const Curves c = compute(task);
  Table table{
      {"torque (% of the limits)", "kinetic chain (m/s)", "in phase with joint 2 held (m/s)",
       "free form with joint 2 held (m/s)", "in phase (m/s)", "free form (m/s)"},
      {}};
  for (std::size_t i = 0; i < kShares.size(); ++i)
    table.rows.push_back({100 * kShares[i], c.chain[i], c.held[i], c.held_ceiling.speeds[i],
                          c.free[i], c.free_ceiling.speeds[i]});
  const std::string stem = task.folder + "/fig_budget";
  writeCsv(table, stem + ".csv");
  const std::string commands =
      kStyle +
      fmt::format(
          R"(set title 'Fastest release against the torque that may be used, speed limits of {}' font ',15'
set xlabel 'torque (% of the limits)'; set ylabel 'release speed (m/s)'
set xrange [0:105]; set yrange [0:9]; set key bottom right
set label 1 'speed limits alone, joint 2 held' at 2,{:.3f} offset 0,0.6 tc rgb {}
set label 2 'speed limits alone' at 2,{:.3f} offset 0,0.6 tc rgb {}
plot {:.4f} w l dt 3 lc rgb {}, {:.4f} w l dt 3 lc rgb {}, \
  $b u 1:6 w lp pt 11 ps 1.4 lw 2.5 dt 2 lc rgb {} title 'free form, all joints', \
  $b u 1:5 w lp pt 9 ps 1.4 lw 2.5 lc rgb {} title 'all joints in phase', \
  $b u 1:4 w lp pt 4 ps 1.2 lw 2.5 dt 2 lc rgb '#000000' title 'free form, joint 2 held', \
  $b u 1:3 w lp pt 5 ps 1.2 lw 2.5 lc rgb {} title 'joints 1, 3, 4 in phase', \
  $b u 1:2 w lp pt 7 ps 1.2 lw 2.5 lc rgb {} title 'kinetic chain (sin, exp, sin; joint 2 held)'
)",
          task.experiment.arm.profile, c.held_ceiling.bound, kGrey, c.free_ceiling.bound, kGrey,
          c.held_ceiling.bound, kGrey, c.free_ceiling.bound, kGrey, kYellow, kColours[2],
          kColours[1], kColours[0]);
  drawPicture(stem, 1100, 780, dataBlock("b", plotData(table)), commands);
  return captionOf(task.experiment.arm.profile, c);
}

}  // namespace fastball::launch
