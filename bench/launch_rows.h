#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// How long `fastball up` takes for the experiment on three machines, from the moment at which their ssh answers.
std::vector<Benchmark> launchBenchmarks();

}  // namespace fastball::bench
