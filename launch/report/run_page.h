#pragma once

#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/report/logged_run.h"
#include "launch/report/missing.h"
#include "launch/report/picture_tasks.h"

namespace fastball::launch {

/// What a page shows beside the log.
struct RunPageParts {
  std::string experiment;  ///< where the experiment file came from, in words
  Missing missing;
  std::vector<DrawnPicture> pictures;
};

/// The report of a run as a page of HTML, with its pictures in the same folder.
std::string runPage(const LoggedRun& run,
                    const config::Experiment& experiment,
                    const RunPageParts& parts);

/// One line a throw, as CSV: what the page's table of throws has.
std::string throwsCsv(const LoggedRun& run, const config::Experiment& experiment);

}  // namespace fastball::launch
