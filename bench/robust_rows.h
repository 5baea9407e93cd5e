#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How little it matters when the ball leaves: strategy `robust` at the default target, beside strategy `paper`.
std::vector<Benchmark> robustBenchmarks();

}  // namespace fastball::bench
