#pragma once

#include <string>
#include <vector>

#include "launch/roster.h"

namespace fastball::launch {

/// What is wrong with the key of one of the processes `names`, where the run has the key `key_id`
/// (CommandKey::id(), empty: none): a sentence on the first that has another, or empty. It would
/// refuse every command of this run. Who hears no commands, or was not heard, has none to compare.
std::string keyFault(const Roster& roster,
                     const std::vector<std::string>& names,
                     const std::string& key_id);

}  // namespace fastball::launch
