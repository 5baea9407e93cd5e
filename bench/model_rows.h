#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// The arm's dynamics and the ball's flight.
std::vector<Benchmark> modelBenchmarks();

}  // namespace fastball::bench
