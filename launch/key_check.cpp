#include "launch/key_check.h"

#include <fmt/format.h>

#include "launch/experiment_processes.h"
#include "messaging/heartbeat.h"

namespace fastball::launch {
namespace {

std::string faultOf(const heartbeat_t& heartbeat, const std::string& key_id) {
  const std::string its = messaging::keyIdOf(heartbeat);
  if (its == key_id)
    return "";
  const auto words = [](const std::string& id) { return id.empty() ? "no key" : "key " + id; };
  return fmt::format(
      "{} (process {} on {}) has {}, this run has {}: give all processes the same --key FILE",
      heartbeat.name, heartbeat.pid, heartbeat.host, words(its), words(key_id));
}

}  // namespace

std::string keyFault(const Roster& roster,
                     const std::vector<std::string>& names,
                     const std::string& key_id) {
  for (const std::string& name : names) {
    const heartbeat_t* heartbeat = roster.newest(name);
    if (heartbeat == nullptr || !hearsCommands(name))
      continue;
    if (std::string fault = faultOf(*heartbeat, key_id); !fault.empty())
      return fault;
  }
  return "";
}

}  // namespace fastball::launch
