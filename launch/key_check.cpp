#include "launch/key_check.h"

#include <fmt/format.h>

#include "messaging/heartbeat.h"

namespace fastball::launch {

std::string keyFault(const heartbeat_t& heartbeat, const std::string& key_id) {
  const std::string its = messaging::keyIdOf(heartbeat);
  if (its == key_id)
    return "";
  const auto words = [](const std::string& id) { return id.empty() ? "no key" : "key " + id; };
  return fmt::format(
      "{} (process {} on {}) has {}, this run has {}: give all processes the same --key FILE",
      heartbeat.name, heartbeat.pid, heartbeat.host, words(its), words(key_id));
}

}  // namespace fastball::launch
