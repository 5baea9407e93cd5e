#pragma once

#include <string>
#include <vector>

#include "launch/processes.h"
#include "launch/roster.h"

namespace fastball::launch {

/// Tells whether another run is on the same network, by the HEARTBEATs heard there.
class StrangerCheck {
 public:
  /// Both must live as long. @param processes those that this run has started
  StrangerCheck(const Roster& roster, const Processes& processes);

  /// A process called one of `names` (empty: called anything) that is neither this one nor one of
  /// this run's: one sentence with what to do about it, which names `lcm_url`; empty: there is
  /// none.
  std::string fault(const std::vector<std::string>& names, const std::string& lcm_url) const;

 private:
  bool isOurs(const heartbeat_t& heartbeat) const;

  const Roster& roster_;
  const Processes& processes_;
  const std::string host_;  ///< this one
};

}  // namespace fastball::launch
