#pragma once

#include <string>

#include "lcmtypes/fastball_types.h"

namespace fastball::launch {

/// What is wrong with the key of the process that says this HEARTBEAT, where the run has the key `key_id` (CommandKey::id(),
/// empty: none): one sentence, or empty. A process with another key would refuse every command of this run.
std::string keyFault(const heartbeat_t& heartbeat, const std::string& key_id);

}  // namespace fastball::launch
