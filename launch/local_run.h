#pragma once

#include "launch/progress.h"
#include "launch/results.h"
#include "launch/run_setup.h"

namespace fastball::launch {

/// The experiment in this process, without network or log: the same nodes wired through memory. Gives the same throws as
/// runOverNetwork, bit for bit, wall times aside. Returns also when the run failed: then result.error says why.
void runInOneProcess(const RunSetup& setup, Progress& progress, RunResult& result);

}  // namespace fastball::launch
