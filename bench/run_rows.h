#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// The whole experiment: a real `fastball run` with all processes, measured once for all its rows.
std::vector<Benchmark> runBenchmarks();

}  // namespace fastball::bench
