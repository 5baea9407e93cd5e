#pragma once

#include <map>
#include <string>
#include <vector>

#include "messaging/endpoint.h"

namespace fastball::launch {

/// Who is there: the newest HEARTBEAT of every process heard.
class Roster {
 public:
  explicit Roster(messaging::Endpoint& endpoint);
  Roster(const Roster&) = delete;
  Roster& operator=(const Roster&) = delete;

  /// Newest HEARTBEAT under that name, or null.
  const heartbeat_t* newest(const std::string& name) const;
  /// True if the process holds that plan, in that state (empty: any state).
  bool holds(const std::string& name, int64_t plan_id, const std::string& state = "") const;
  /// The newest HEARTBEAT of every process (pid and host) heard, also of two under one name.
  std::vector<heartbeat_t> everyone() const;

 private:
  std::map<std::string, heartbeat_t> by_name_;
  std::map<std::pair<std::string, int32_t>, heartbeat_t> by_process_;
};

}  // namespace fastball::launch
