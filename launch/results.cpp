#include "launch/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fastball::launch {
namespace {

constexpr double kMilli = 1e3;

nlohmann::json millimetres(const Eigen::Vector2d& v) {
  return {v.x() * kMilli, v.y() * kMilli};
}

std::string millimetreText(const Eigen::Vector2d& v) {
  return fmt::format("({:+.1f}, {:+.1f}) mm", v.x() * kMilli, v.y() * kMilli);
}

nlohmann::json toJson(const JudgedThrow& judged) {
  const Throw& seen = judged.seen;
  const Truth& truth = judged.truth;
  nlohmann::json object = {{"index", seen.number - 1},
                           {"plan_ms", seen.plan_ms},
                           {"planned_speed_mps", seen.planned_speed},
                           {"duration_s", seen.duration},
                           {"release_speed_mps", nullptr},
                           {"release_utime", nullptr},
                           {"landing_measured_mm", nullptr},
                           {"landing_sigma_mm", nullptr},
                           {"landing_true_mm", nullptr},
                           {"hit", judged.hit},
                           {"note", seen.note}};
  if (truth.release_speed)
    object["release_speed_mps"] = *truth.release_speed;
  if (truth.release_utime)
    object["release_utime"] = *truth.release_utime;
  if (seen.measured) {
    object["landing_measured_mm"] = millimetres(seen.landing);
    object["landing_sigma_mm"] = millimetres(seen.landing_sigma);
  }
  if (truth.landing)
    object["landing_true_mm"] = millimetres(*truth.landing);
  return object;
}

}  // namespace

JudgedThrow judge(const Throw& seen, const Truth& truth, double target_radius) {
  JudgedThrow judged{seen, truth, false};
  judged.hit = truth.landing && truth.landing->norm() < target_radius;
  if (!truth.touched.empty()) {
    if (!judged.seen.note.empty())
      judged.seen.note += "; ";
    judged.seen.note += "touched again after the release: " + truth.touched;
  }
  return judged;
}

int RunResult::hits() const {
  return static_cast<int>(
      std::count_if(throws.begin(), throws.end(), [](const auto& t) { return t.hit; }));
}

nlohmann::json toJson(const RunResult& result) {
  nlohmann::json throws = nlohmann::json::array();
  for (const JudgedThrow& judged : result.throws)
    throws.push_back(toJson(judged));
  nlohmann::json object = {{"version", result.version},
                           {"seed", result.seed},
                           {"strategy", result.strategy},
                           {"arm", result.arm},
                           {"throws", throws},
                           {"hits", result.hits()},
                           {"log", result.log},
                           {"throw_wall_s", result.throw_wall_s}};
  if (!result.error.empty())
    object["error"] = result.error;
  return object;
}

std::string throwLine(const JudgedThrow& judged) {
  const Throw& seen = judged.seen;
  const Truth& truth = judged.truth;
  std::string line = fmt::format("throw {}: planned in {:.0f} ms, ", seen.number, seen.plan_ms);
  line += truth.release_speed ? fmt::format("released at {:.2f} m/s (plan {:.2f}), ",
                                            *truth.release_speed, seen.planned_speed)
                              : std::string("never released, ");
  line += seen.measured
              ? fmt::format("landing {} +- ({:.1f}, {:.1f})", millimetreText(seen.landing),
                            seen.landing_sigma.x() * kMilli, seen.landing_sigma.y() * kMilli)
              : std::string("landing not measured");
  line += truth.landing ? ", true " + millimetreText(*truth.landing)
                        : std::string(", never crossed the target plane");
  line += judged.hit ? ": hit" : ": miss";
  if (!seen.note.empty())
    line += " (" + seen.note + ")";
  return line;
}

void writeJson(const nlohmann::json& object, const std::string& path) {
  std::ofstream file(path);
  // Notes come from other processes, whose bytes may be no UTF-8.
  file << object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  file.close();
  if (!file)
    throw std::runtime_error(fmt::format("cannot write {}", path));
}

}  // namespace fastball::launch
