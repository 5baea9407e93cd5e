#pragma once

#include "launch/progress.h"
#include "launch/results.h"
#include "launch/run_setup.h"

namespace fastball::launch {

/// The experiment as processes over LCM: starts them, conducts the throws, stops them, the logger last. Returns also when the run
/// failed or was interrupted: then result.error says why, and the throws made so far are in it.
/// @throw std::runtime_error if the network cannot be used or another run is on it.
void runOverNetwork(const RunSetup& setup, Progress& progress, RunResult& result);

}  // namespace fastball::launch
