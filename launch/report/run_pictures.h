#pragma once

#include <string>

#include "config/experiment.h"
#include "launch/report/logged_run.h"

/// Pictures of a whole run, as those of a throw.
namespace fastball::launch {

/// All landings in the net's face with their 95 % ellipses, measured and true; and both over the number of the throw.
std::string drawRunLandings(const LoggedRun& run,
                            const config::Experiment& experiment,
                            const std::string& path_stem);

/// How long the loops of each process took.
std::string drawLoops(const LoggedRun& run, const std::string& path_stem);

}  // namespace fastball::launch
