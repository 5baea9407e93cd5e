#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "launch/spy/traffic.h"

namespace fastball::launch {

/// A channel as one object of `fastball spy --json`: what is unknown is null. `now` [us since 1970].
nlohmann::json toJson(const ChannelReport& report,
                      const std::vector<messaging::MessageField>& fields,
                      int64_t now);

/// The channels as a table in printable ASCII: a heading and one line a channel, all equally long. Where that is more than
/// `max_width`, names of types are shortened, down to none.
struct TrafficTable {
  std::string heading;
  std::vector<std::string> lines;
};
TrafficTable trafficTable(const std::vector<ChannelReport>& reports, std::size_t max_width = 1000);

}  // namespace fastball::launch
