#pragma once

#include <map>
#include <string>
#include <vector>

#include "launch/replay_comparison.h"

namespace fastball::launch {

/// The processes that rerun() can feed: planner, controller, hand, tracker.
std::vector<std::string> rerunProcesses();

/// Starts one process of the experiment afresh, feeds it its recorded inputs in their order, as fast as it answers, and compares
/// everything it says with the recording (MessageComparison). Nothing depends on the recorded times.
/// @return the channels that it says, each of which is in the log or has `recorded` = 0.
/// @throw std::invalid_argument if the log cannot be read or holds none of the messages of that process.
/// @throw std::runtime_error if the process does not start, or ends.
std::map<std::string, ComparedChannel> rerun(const std::string& process,
                                             const std::string& log_path,
                                             const std::string& config_path);

}  // namespace fastball::launch
