#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// What a key costs.
std::vector<Benchmark> keyBenchmarks();

}  // namespace fastball::bench
