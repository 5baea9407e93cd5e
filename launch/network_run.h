#pragma once

#include "launch/progress.h"
#include "launch/results.h"
#include "launch/run_setup.h"

namespace fastball::launch {

/// The experiment as processes over LCM: starts them, conducts the throws, stops them, the logger
/// last; or, with setup.on_system, finds those of a system and leaves them running. Returns also
/// when the run failed, was interrupted, or found another run on the network: then result.error
/// says why, and the throws made so far are in it.
/// @throw std::invalid_argument if the URL does not parse.
/// @throw std::runtime_error if the network cannot be used.
void runOverNetwork(const RunSetup& setup, Progress& progress, RunResult& result);

}  // namespace fastball::launch
