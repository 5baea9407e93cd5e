#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How well the tracker measures: against the Cramer-Rao bound, in drawn images, and how fast.
std::vector<Benchmark> visionBenchmarks();

}  // namespace fastball::bench
