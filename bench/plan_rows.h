#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// Planning a throw.
std::vector<Benchmark> planBenchmarks();

}  // namespace fastball::bench
