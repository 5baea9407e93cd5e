#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastball::launch {

/// Works on a campaign's folder with processes of this machine, each with every `jobs`-th of the units in `todo` (runPart()).
/// @param watch called ten times a second meanwhile; returns false to stop: the processes end after the throw they are at.
/// @return one sentence for each process that failed.
std::vector<std::string> workLocally(const std::string& folder,
                                     const std::string& todo,
                                     int jobs,
                                     const std::function<bool()>& watch);

}  // namespace fastball::launch
