#pragma once

#include <string>
#include <vector>

#include "launch/processes.h"
#include "launch/run_setup.h"

namespace fastball::launch {

/// Name of the process that keeps the log: started first, stopped last.
inline constexpr const char* kLogger = "logger";

/// Whether the process called `name` obeys commands, so that it must have the run's key. The logger keeps all bytes as they come.
bool hearsCommands(const std::string& name);

/// How each process of an experiment is started for a run, the logger first.
std::vector<ProcessCommand> experimentProcesses(const RunSetup& setup);
std::vector<std::string> namesOf(const std::vector<ProcessCommand>& all);

}  // namespace fastball::launch
