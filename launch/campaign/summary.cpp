#include "launch/campaign/summary.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

nlohmann::json toJson(const CaseSummary& s) {
  nlohmann::json by_throw = nlohmann::json::array();
  for (const Rate& rate : s.by_throw)
    by_throw.push_back(
        {{"throws", rate.of}, {"hits", rate.count}, {"wilson", {rate.low(), rate.high()}}});
  const Eigen::Matrix2d& c = s.covariance;
  const double to_mm2 = kMilli * kMilli;
  return {{"throws", s.hits.of},
          {"hits", s.hits.count},
          {"hit_rate", s.hits.value()},
          {"wilson", {s.hits.low(), s.hits.high()}},
          {"clean_rate", s.cleans.value()},
          {"clean_wilson", {s.cleans.low(), s.cleans.high()}},
          {"landed", s.landed},
          {"bias_mm", {kMilli * s.bias.x(), kMilli * s.bias.y()}},
          {"sigma_mm", {kMilli * s.deviation(0), kMilli * s.deviation(1)}},
          {"covariance_mm2", {to_mm2 * c(0, 0), to_mm2 * c(0, 1), to_mm2 * c(1, 1)}},
          {"release_speed_mps", s.release_speed},
          {"by_throw", by_throw},
          {"from_third_throw",
           {{"throws", s.settled_hits.of},
            {"hits", s.settled_hits.count},
            {"hit_rate", s.settled_hits.value()},
            {"wilson", {s.settled_hits.low(), s.settled_hits.high()}},
            {"clean_rate", s.settled_cleans.value()}}}};
}

std::string quoted(std::string text) {
  for (std::size_t i = 0; (i = text.find('"', i)) != std::string::npos; i += 2)
    text.insert(i, 1, '"');
  return '"' + text + '"';
}

std::string pair(const std::optional<Eigen::Vector2d>& v) {
  return v ? fmt::format("{:.3f},{:.3f}", kMilli * v->x(), kMilli * v->y()) : ",";
}

}  // namespace

nlohmann::json campaignJson(const Campaign& campaign,
                            const std::map<Unit, UnitResult>& record,
                            double throws_per_minute) {
  nlohmann::json cases = nlohmann::json::object();
  for (std::size_t i = 0; i < campaign.cases.size(); ++i)
    cases[campaign.cases[i].name] = toJson(summarise(record, static_cast<int>(i)));
  return {{"version", campaign.version},
          {"seed", campaign.seed},
          {"set_up_throws", campaign.set_up_throws},
          {"images", campaign.images},
          {"strategies", cases},
          {"throws_per_minute", throws_per_minute}};
}

std::string campaignTable(const Campaign& campaign, const std::map<Unit, UnitResult>& record) {
  std::size_t width = 8;
  for (const Case& one : campaign.cases)
    width = std::max(width, one.name.size());
  std::string table = fmt::format(
      "{:{}}  throws   hit %  (95 %)         clean %  3rd on %  mean [mm]         sd [mm]\n", "",
      width);
  for (std::size_t i = 0; i < campaign.cases.size(); ++i) {
    const CaseSummary s = summarise(record, static_cast<int>(i));
    table += fmt::format(
        "{:{}}  {:6}  {:6.2f}  {:5.2f}..{:6.2f}   {:6.2f}   {:7.2f}  ({:+6.1f}, {:+6.1f})  "
        "({:.1f}, "
        "{:.1f})\n",
        campaign.cases[i].name, width, s.hits.of, 100 * s.hits.value(), 100 * s.hits.low(),
        100 * s.hits.high(), 100 * s.cleans.value(), 100 * s.settled_hits.value(),
        kMilli * s.bias.x(), kMilli * s.bias.y(), kMilli * s.deviation(0), kMilli * s.deviation(1));
  }
  return table;
}

void writeThrowsCsv(const Campaign& campaign,
                    const std::map<Unit, UnitResult>& record,
                    const std::string& path) {
  std::ofstream file(path);
  file << "case,seed,throw,hit,clean,right_mm,up_mm,measured_right_mm,measured_up_mm,"
          "release_speed_mps,note\n";
  for (const auto& [unit, result] : record) {
    const Case& one = campaign.cases.at(static_cast<std::size_t>(unit.case_index));
    for (std::size_t k = 0; k < result.throws.size(); ++k) {
      const ThrowOutcome& thrown = result.throws[k];
      fmt::print(file, "{},{},{},{:d},{:d},{},{},{:.4f},{}\n", quoted(one.name),
                 campaign.seed + unit.set_up, k + 1, thrown.hit, thrown.clean, pair(thrown.landing),
                 pair(thrown.measured), thrown.release_speed, quoted(thrown.note));
    }
  }
  if (!file.flush())
    throw std::runtime_error(fmt::format("{}: cannot be written", path));
}

}  // namespace fastball::launch
