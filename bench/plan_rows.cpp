#include "bench/plan_rows.h"

#include <fmt/format.h>

#include "bench/plan_cost.h"

namespace fastball::bench {
namespace {

Row gradientSpeedup() {
  const SolveCost cost = costOfDefaultThrow();
  return {
      "plan.gradient_speedup",
      cost.differences_seconds / cost.planner_seconds,
      "times",
      "NLopt's SLSQP with differences and all samples",
      1.0,
      fmt::format("{:.2g} ms a start against {:.3g} ms; {} parameters; {:.3f} against {:.3f} m/s, "
                  "whose limits are broken by {:.1g} between the samples",
                  1e3 * cost.planner_seconds, 1e3 * cost.differences_seconds, cost.parameters,
                  cost.planner_speed, cost.differences_speed, cost.differences_violation)};
}

}  // namespace

std::vector<Benchmark> planBenchmarks() {
  return {{"plan.gradient_speedup", gradientSpeedup}};
}

}  // namespace fastball::bench
