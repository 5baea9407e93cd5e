#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How long a real `fastball report` takes over the log of a real run.
std::vector<Benchmark> reportBenchmarks();

}  // namespace fastball::bench
