#pragma once

#include <functional>

#include "launch/progress.h"
#include "launch/results.h"
#include "launch/run_setup.h"
#include "messaging/endpoint.h"

namespace fastball::launch {

/// The experiment in this process, without network or log: the same nodes wired through memory, all
/// on this thread but for the simulator's that draw images. Gives the same throws as
/// runOverNetwork, bit for bit, wall times aside. Returns also when the run failed or SIGINT or
/// SIGTERM interrupted it: then result.error says why.
/// @param listen subscribes to what a listener wants to hear of the run, before it begins.
void runInOneProcess(const RunSetup& setup,
                     Progress& progress,
                     RunResult& result,
                     const std::function<void(messaging::Endpoint&)>& listen = {});

}  // namespace fastball::launch
