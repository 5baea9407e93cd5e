#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How near the simulator's contacts come to a reference with error control.
std::vector<Benchmark> contactBenchmarks();

}  // namespace fastball::bench
