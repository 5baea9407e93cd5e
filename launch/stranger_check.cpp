#include "launch/stranger_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "messaging/heartbeat.h"

namespace fastball::launch {

StrangerCheck::StrangerCheck(const Roster& roster, const Processes& processes)
    : roster_(roster), processes_(processes), host_(messaging::hostName()) {}

bool StrangerCheck::isOurs(const heartbeat_t& heartbeat) const {
  if (heartbeat.host != host_)
    return false;
  return heartbeat.pid == getpid() || heartbeat.pid == processes_.pid(heartbeat.name);
}

std::string StrangerCheck::fault(const std::vector<std::string>& names,
                                 const std::string& lcm_url) const {
  for (const heartbeat_t& heartbeat : roster_.everyone()) {
    if (!names.empty() && std::find(names.begin(), names.end(), heartbeat.name) == names.end())
      continue;
    if (isOurs(heartbeat))
      continue;
    return fmt::format(
        "another run is on {}: its {} (process {} on {}) was heard; end it, or give "
        "this run a port of its own with --lcm-url",
        lcm_url, heartbeat.name, heartbeat.pid, heartbeat.host);
  }
  return "";
}

}  // namespace fastball::launch
