#include "launch/loss_report.h"

#include <fmt/format.h>

namespace fastball::launch {

LossReport::LossReport(messaging::Endpoint& endpoint, const Roster& roster) : roster_(roster) {
  endpoint.subscribe<logger_status_t>(messaging::kLoggerStatus,
                                      [this](const auto& m) { logger_status_ = m; });
}

std::vector<std::string> LossReport::sentences(const std::vector<std::string>& names) const {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    const heartbeat_t* last = roster_.newest(name);
    if (last != nullptr && last->lost + last->invalid > 0) {
      all.push_back(
          fmt::format("{} missed {} messages and refused {}", name, last->lost, last->invalid));
    }
  }
  if (logger_status_.lost > 0 || !logger_status_.message.empty()) {
    all.push_back(fmt::format("the log is not whole: {} messages lost {}", logger_status_.lost,
                              logger_status_.message));
  }
  return all;
}

}  // namespace fastball::launch
