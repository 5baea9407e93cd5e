#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How near the planner comes to what the arm can do, and how soon: speeds as shares of the ceiling, planning times and the
/// share of random targets that are solved.
std::vector<Benchmark> reachBenchmarks();

}  // namespace fastball::bench
