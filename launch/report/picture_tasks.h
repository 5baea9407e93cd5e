#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/experiment.h"
#include "launch/report/logged_run.h"

namespace fastball::launch {

/// A picture of a report: that of one kind of one throw, or of the whole run.
struct PictureTask {
  std::string kind;                                     ///< "throw", "release", ...
  int64_t number = 0;                                   ///< of the throw; 0: of the run
  bool with_numbers = true;                             ///< it leaves a table, too
  std::function<std::string(const std::string&)> draw;  ///< by its path without ending, its caption

  /// Name of its files without ending.
  std::string name() const;
};

/// What became of it.
struct DrawnPicture {
  PictureTask task;
  std::string caption;
  std::string failure;  ///< why there is none, or empty
};

/// All pictures of a run; those that take a tracker only if one took part. `run` and `experiment` must live as long.
std::vector<PictureTask> picturesOf(const LoggedRun& run, const config::Experiment& experiment);

/// Draws them, as many at a time as there are processors. @param folder that exists.
std::vector<DrawnPicture> drawAll(const std::vector<PictureTask>& tasks, const std::string& folder);

/// One sentence for each kind and reason of pictures that could not be drawn.
std::vector<std::string> failuresOf(const std::vector<DrawnPicture>& pictures);

}  // namespace fastball::launch
