#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// Messages between nodes.
std::vector<Benchmark> messagingBenchmarks();

}  // namespace fastball::bench
