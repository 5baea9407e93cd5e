#pragma once

#include <string>
#include <vector>

#include "launch/view/timeline.h"

namespace fastball::view {

/// What a log does not hold and what therefore is not shown, in sentences.
std::vector<std::string> missingFrom(const Timeline& log);

/// The same of a network that has been listened to, at wall time `wall_us` [us since 1970]: only what should have been heard by
/// now is missing. Where no experiment is heard the sentence says how to start one at `lcm_url`.
std::vector<std::string> missingFrom(const Timeline& live,
                                     int64_t wall_us,
                                     const std::string& lcm_url);

/// True if a process of an experiment has spoken in the last seconds.
bool experimentHeard(const Timeline& live, int64_t wall_us);

}  // namespace fastball::view
