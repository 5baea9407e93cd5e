#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// What the logger loses of hard traffic, and how much it can take; beside it LCM's own lcm-logger.
std::vector<Benchmark> loggerBenchmarks();

}  // namespace fastball::bench
