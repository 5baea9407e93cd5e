#pragma once

#include <string>
#include <vector>

#include "launch/view/timeline.h"

namespace fastball::view {

/// What a log does not hold and what therefore is not shown, in sentences.
std::vector<std::string> missingFromLog(const Timeline& log);

/// The same of a network that has been listened to: only what should have been heard by now is missing.
std::vector<std::string> missingFromNetwork(const Timeline& live);

/// True if anything of an experiment was heard in the last three seconds. `wall_us`: now [us since
/// 1970].
bool experimentHeard(const Timeline& live, int64_t wall_us);

}  // namespace fastball::view
