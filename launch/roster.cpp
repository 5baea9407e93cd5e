#include "launch/roster.h"

namespace fastball::launch {

Roster::Roster(messaging::Endpoint& endpoint) {
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& message) {
    by_name_[message.name] = message;
    by_process_[{message.host + "/" + message.name, message.pid}] = message;
  });
}

const heartbeat_t* Roster::newest(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &found->second;
}

bool Roster::holds(const std::string& name, int64_t plan_id, const std::string& state) const {
  const heartbeat_t* heartbeat = newest(name);
  return heartbeat != nullptr && heartbeat->plan_id == plan_id &&
         (state.empty() || heartbeat->state == state);
}

std::vector<heartbeat_t> Roster::everyone() const {
  std::vector<heartbeat_t> all;
  all.reserve(by_process_.size());
  for (const auto& [process, heartbeat] : by_process_)
    all.push_back(heartbeat);
  return all;
}

}  // namespace fastball::launch
