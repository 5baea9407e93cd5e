#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// What `fastball spy` takes of a processor to watch a busy network, and what it misses.
std::vector<Benchmark> spyBenchmarks();

}  // namespace fastball::bench
