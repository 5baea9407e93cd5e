#pragma once

#include <vector>

#include "bench/row.h"

namespace fastball::bench {

/// The simulator's physics, the drawing of camera images, and the search for the ball in them.
std::vector<Benchmark> sceneBenchmarks();

}  // namespace fastball::bench
