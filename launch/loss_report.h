#pragma once

#include <string>
#include <vector>

#include "launch/roster.h"
#include "messaging/endpoint.h"

namespace fastball::launch {

/// What of a run's messages did not arrive, as the processes and the logger tell it.
class LossReport {
 public:
  /// Both must live as long. @param roster of the same endpoint
  LossReport(messaging::Endpoint& endpoint, const Roster& roster);
  LossReport(const LossReport&) = delete;
  LossReport& operator=(const LossReport&) = delete;

  /// A sentence on each process called one of `names` that has missed or refused messages, in their
  /// order, and last one on a log that is not whole.
  std::vector<std::string> sentences(const std::vector<std::string>& names) const;

 private:
  const Roster& roster_;
  logger_status_t logger_status_{};  ///< the newest
};

}  // namespace fastball::launch
