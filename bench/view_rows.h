#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// What an experiment costs while somebody looks on with `fastball view`.
std::vector<Benchmark> viewBenchmarks();

}  // namespace fastball::bench
