#include "launch/spy/traffic_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "launch/spy/field_summary.h"

namespace fastball::launch {
namespace {

constexpr double kSeconds = 1e-6;
constexpr double kMilliseconds = 1e3;

template <class T>
nlohmann::json orNull(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

/// "850 B/s", "13.6 kB/s", "5.8 MB/s"
std::string bandwidthWords(double bandwidth) {
  if (bandwidth < 1e3)
    return fmt::format("{:.0f} B/s", bandwidth);
  return bandwidth < 1e6 ? fmt::format("{:.1f} kB/s", 1e-3 * bandwidth)
                         : fmt::format("{:.1f} MB/s", 1e-6 * bandwidth);
}

/// "12 ms", "3.1 s"
std::string ageWords(double age) {
  return age < 1 ? fmt::format("{:.0f} ms", kMilliseconds * age) : fmt::format("{:.1f} s", age);
}

/// The end of a name of a type tells most.
std::string fitted(const std::string& text, std::size_t cells) {
  return text.size() > cells ? text.substr(text.size() - cells) : text;
}

}  // namespace

nlohmann::json toJson(const ChannelReport& report,
                      const std::vector<messaging::MessageField>& fields,
                      int64_t now) {
  std::optional<double> jitter_ms;
  if (report.jitter)
    jitter_ms = kMilliseconds * *report.jitter;
  return {{"time", kSeconds * static_cast<double>(now)},
          {"channel", report.channel},
          {"type", report.type},
          {"count", report.count},
          {"rate_hz", report.rate},
          {"bytes_per_s", report.bandwidth},
          {"jitter_ms", orNull(jitter_ms)},
          {"age_ms", kMilliseconds * report.age},
          {"lost", orNull(report.lost)},
          {"undecodable", report.undecodable},
          {"fields", fieldsJson(fields)}};
}

TrafficTable trafficTable(const std::vector<ChannelReport>& reports, std::size_t max_width) {
  std::size_t width = 7;
  std::size_t type_width = 4;
  for (const ChannelReport& report : reports) {
    width = std::max(width, report.channel.size());
    type_width = std::max(type_width, report.type.size());
  }
  // All but the two names, with the spaces between.
  constexpr std::size_t kNumberCells = 70;
  const std::size_t names = max_width - std::min(max_width, kNumberCells);
  type_width = std::min(type_width, names - std::min(names, width));
  constexpr const char* kLayout = "{:{}}  {:{}} {:>9} {:>9} {:>11} {:>10} {:>8} {:>7} {:>7}";
  TrafficTable table;
  table.heading = fmt::format(kLayout, "channel", width, fitted("type", type_width), type_width,
                              "messages", "Hz", "bandwidth", "jitter", "age", "lost", "undec.");
  for (const ChannelReport& report : reports) {
    table.lines.push_back(
        fmt::format(kLayout, printable(report.channel), width,
                    fitted(printable(report.type), type_width), type_width, report.count,
                    fmt::format("{:.1f}", report.rate), bandwidthWords(report.bandwidth),
                    report.jitter ? fmt::format("{:.3f} ms", kMilliseconds * *report.jitter) : "-",
                    ageWords(report.age), report.lost ? std::to_string(*report.lost) : "-",
                    report.undecodable));
  }
  return table;
}

}  // namespace fastball::launch
