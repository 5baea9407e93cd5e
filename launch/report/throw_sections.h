#pragma once

#include "launch/html.h"
#include "launch/report/run_page.h"

namespace fastball::launch {

/// Landings, speeds and verdicts of all throws.
Html throwTable(const LoggedRun& run, const config::Experiment& experiment);

/// How near each throw came to the limits of the joints.
Html limitTable(const LoggedRun& run, const config::Experiment& experiment);

/// A heading and the pictures of each throw.
Html throwSections(const LoggedRun& run,
                   const config::Experiment& experiment,
                   const std::vector<DrawnPicture>& pictures);

}  // namespace fastball::launch
