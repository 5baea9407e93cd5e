#include "launch/spy/spy_output.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "launch/spy/traffic_text.h"

namespace fastball::launch {
namespace {

void flushOutput() {
  if (!std::cout.flush())
    throw std::runtime_error("cannot write to standard output");
}

}  // namespace

void JsonOutput::show(const Traffic& traffic, int64_t now) {
  for (const ChannelReport& report : traffic.report(now)) {
    const auto object = toJson(report, traffic.newestFields(report.channel), now);
    // Names and texts come from anyone, in any encoding.
    std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  }
  flushOutput();
}

void TableOutput::show(const Traffic& traffic, int64_t now) {
  const TrafficTable table = trafficTable(traffic.report(now));
  std::cout << table.heading << '\n';
  for (const std::string& line : table.lines)
    std::cout << line << '\n';
  std::cout << '\n';
  flushOutput();
}

}  // namespace fastball::launch
