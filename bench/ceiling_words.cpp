#include "bench/ceiling_words.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace fastball::bench {
namespace {

/// "any direction" or "(3, 0, -0.5) m".
std::string placeWords(const model::Target& target, const CeilingOptions& options) {
  const Eigen::Vector3d& p = target.p_WTarget;
  return options.must_land ? fmt::format("({:.3g}, {:.3g}, {:.3g}) m", p.x(), p.y(), p.z())
                           : std::string("any direction");
}

std::string limitWords(const std::vector<LimitUsed>& limits) {
  std::string words;
  for (const LimitUsed& limit : limits) {
    words += fmt::format("; {} {:.0f} %", limit.name, 100 * limit.at_release);
    if (limit.time_active > 0.01)
      words += fmt::format(" (on it for {:.0f} % of the swing)", 100 * limit.time_active);
  }
  return words;
}

nlohmann::json vectorJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

std::string ceilingLine(const Ceiling& ceiling,
                        const model::Target& target,
                        const CeilingOptions& options) {
  const std::string head =
      fmt::format("{}, {}{:.0f} % torque: ", placeWords(target, options),
                  options.hold_shoulder ? "joint 2 held, " : "", 100 * options.torque_share);
  if (!ceiling.found)
    return head + fmt::format("no throw found in {} starts", ceiling.starts);
  std::string line = head + fmt::format("{:.3f} m/s", ceiling.release_speed);
  if (ceiling.bound > 0) {
    line += fmt::format(", {:.2f} % of the {:.3f} m/s that the speed limits allow",
                        100 * ceiling.release_speed / ceiling.bound, ceiling.bound);
  }
  return line + limitWords(ceiling.check.limits) +
         fmt::format("; {} of {} starts came to it", ceiling.starts_near_best, ceiling.starts);
}

nlohmann::json ceilingJson(const Ceiling& ceiling,
                           const model::Target& target,
                           const CeilingOptions& options) {
  nlohmann::json object;
  object["target"] = options.must_land ? vectorJson(target.p_WTarget) : nlohmann::json();
  object["hold_shoulder"] = options.hold_shoulder;
  object["across_forearm"] = options.across_forearm;
  object["torque_share"] = options.torque_share;
  object["speed_share"] = options.speed_share;
  object["bound"] = ceiling.bound > 0 ? nlohmann::json(ceiling.bound) : nlohmann::json();
  object["starts"] = ceiling.starts;
  object["starts_near_best"] = ceiling.starts_near_best;
  object["release_speed"] = nullptr;
  if (!ceiling.found)
    return object;
  object["release_speed"] = ceiling.release_speed;
  object["violation"] = ceiling.check.violation;
  object["duration"] = ceiling.trajectory.duration();
  object["t_release"] = ceiling.t_release;
  object["flight_time"] = ceiling.check.flight_time;
  object["p_WBall"] = vectorJson(ceiling.check.release.p_WBall);
  object["v_WBall"] = vectorJson(ceiling.check.release.v_WBall);
  object["limits"] = nlohmann::json::array();
  for (const LimitUsed& limit : ceiling.check.limits) {
    object["limits"].push_back({{"name", limit.name},
                                {"at_release", limit.at_release},
                                {"time_active", limit.time_active}});
  }
  return object;
}

}  // namespace fastball::bench
