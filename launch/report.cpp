#include "launch/report.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "launch/release_drawing.h"

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

void drawPictures(const ThrowRecord& record,
                  int64_t number,
                  const config::Experiment& experiment,
                  const std::string& folder,
                  std::vector<std::string>& failures) {
  const auto attempt = [&](const char* what, const auto& draw) {
    try {
      draw(fmt::format("{}/{}-{}", folder, what, number));
    } catch (const std::runtime_error& error) {
      failures.push_back(
          fmt::format("throw {} has no picture {}-{}: {}", number, what, number, error.what()));
    }
  };
  attempt("throw",
          [&](const std::string& path_stem) { drawThrow(record, number, experiment, path_stem); });
  attempt("release", [&](const std::string& path_stem) {
    const std::string caption =
        drawRelease(record, experiment, fmt::format("Throw {}", number), path_stem);
    if (!(std::ofstream(path_stem + ".txt") << caption << '\n').flush())
      throw std::runtime_error(fmt::format("cannot write '{}.txt'", path_stem));
  });
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
    drawPictures(record, number, experiment, folder, failures);
  }
  if (!csv.flush())
    throw std::runtime_error(fmt::format("cannot write '{}/throws.csv'", folder));
  return failures;
}

}  // namespace fastball::launch
