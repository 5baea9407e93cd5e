#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How many throws a minute a campaign makes: real `fastball campaign` processes, each on a folder of its own.
std::vector<Benchmark> campaignBenchmarks();

}  // namespace fastball::bench
