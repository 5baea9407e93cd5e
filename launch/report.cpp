#include "launch/report.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace fastball::launch {
namespace {

double norm(const double v[3]) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

std::string csvLine(int64_t number, const ThrowRecord& record) {
  std::string line = fmt::format("{}", number);
  if (record.plan)
    line += fmt::format(",{},{:.4f}", record.plan->strategy, norm(record.plan->v_WBall_release));
  else
    line += ",,";
  line += record.departed ? fmt::format(",{}", record.departed->utime) : ",";
  if (record.landing && record.landing->measured) {
    const landing_t& landing = *record.landing;
    line += fmt::format(",{:.2f},{:.2f},{:.2f},{:.2f},{},{:.3f}", 1e3 * landing.landing[0],
                        1e3 * landing.landing[1], 1e3 * std::sqrt(landing.cov_landing[0]),
                        1e3 * std::sqrt(landing.cov_landing[2]), landing.n_observations,
                        landing.residual_px);
  } else {
    line += ",,,,,,";
  }
  return line + "\n";
}

}  // namespace

std::vector<std::string> writeReport(const std::string& log_path,
                                     const config::Experiment& experiment,
                                     const std::string& folder) {
  const auto throws = readThrows(log_path);
  std::filesystem::create_directories(folder);
  std::vector<std::string> failures;
  std::ofstream csv(folder + "/throws.csv");
  csv << "throw,strategy,planned_release_speed_mps,departure_utime,landing_right_mm,landing_up_mm,"
         "sigma_right_mm,sigma_up_mm,observations,residual_px\n";
  for (const auto& [number, record] : throws) {
    csv << csvLine(number, record);
    try {
      drawThrow(record, number, experiment, fmt::format("{}/throw-{}", folder, number));
    } catch (const std::runtime_error& error) {
      failures.push_back(fmt::format("throw {} has no picture: {}", number, error.what()));
    }
  }
  if (!csv.flush())
    throw std::runtime_error(fmt::format("cannot write '{}/throws.csv'", folder));
  return failures;
}

}  // namespace fastball::launch
