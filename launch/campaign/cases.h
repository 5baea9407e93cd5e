#pragma once

#include <string>
#include <vector>

#include "launch/campaign/campaign.h"

namespace fastball::launch {

/// What a campaign varies beside the strategy.
///   none      nothing
///   causes    each error switched off in turn, and each alone
///   errors    each error at half, twice and four times its size
///   scale     all errors at 0, 0.5, 1.5, 2 and 3 times their size
///   distance  of the target: 2 to 4 m
///   height    of the target: -0.8 to 0.8 m
///   azimuth   of the target: -60 to 60 degrees
///   region    of the target: 50 places that the arm reaches, drawn by the seed (launch/campaign/region.h)
///   ball      Young's modulus of the real ball: 1e5 to 1e7 Pa, foam to hard
///   speed     speed that the planner wants of a throw through a window: 4 to 6 m/s
const std::vector<std::string>& studyNames();

struct StudyRequest {
  std::string study;  ///< of studyNames()
  std::vector<std::string> strategies;
  std::string config;       ///< experiment file
  std::string uncertainty;  ///< file of errors
  std::string
      arm;  ///< profile in place of the experiment's, e.g. "wam4-90v"; empty: the experiment's
  int64_t seed = 1;  ///< of what a study draws
};

/// The cases of a study. What differs from the given files is written to `folder` (made if absent)
/// as files of its own, so that `fastball run --config --uncertainty` can make each throw again.
/// @throw std::invalid_argument with a sentence if a file cannot be read, or as reachablePlaces().
/// @throw YAML::Exception, a std::runtime_error, if the files do not have what is varied.
std::vector<Case> casesOf(const StudyRequest& request, const std::string& folder);

}  // namespace fastball::launch
