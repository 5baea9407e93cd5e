#include "bench/run_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/system.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "bench/timing.h"
#include "launch/processes.h"

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr const char* kThrows = "3";

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The JSON object of a run of three throws with all processes and images, on a port of its own.
nlohmann::json threeThrows() {
  const fs::path folder = fs::temp_directory_path() / fmt::format("fastball-bench-{}", getpid());
  fs::create_directories(folder);
  const fs::path json = folder / "run.json";
  const std::vector<std::string> arguments = {
      "run",       "--throws",     kThrows, "--json", json, "--log", folder / "run.lcmlog",
      "--lcm-url", privateLcmUrl()};
  const int status = bp::system(bp::exe = launch::programFolder() + "/fastball",
                                bp::args = arguments, bp::std_out > bp::null);
  std::ifstream file(json);
  const nlohmann::json result = nlohmann::json::parse(file, nullptr, false);
  fs::remove_all(folder);
  if (status != 0)
    throw std::runtime_error(fmt::format("the measured run ended with exit status {}", status));
  return result;
}

/// The number under `key` of every throw.
std::vector<double> ofThrows(const nlohmann::json& run, const char* key) {
  std::vector<double> values;
  for (const auto& object : run.at("throws"))
    values.push_back(object.at(key));
  return values;
}

}  // namespace

std::vector<Benchmark> runBenchmarks() {
  // Measured when the first row asks for it.
  auto run = std::make_shared<nlohmann::json>();
  const auto result = [run]() -> const nlohmann::json& {
    if (run->is_null())
      *run = threeThrows();
    return *run;
  };
  return {{"run.throw_wall_s",
           [result] {
             return Row{
                 "run.throw_wall_s",
                 mean(result().at("throw_wall_s")),
                 "s",
                 "simulated time of the throw",
                 mean(ofThrows(result(), "duration_s")),
                 "all processes and images in lockstep, from PLAN_REQUEST to LANDING, mean of 3"};
           }},
          {"run.plan_ms", [result] {
             return Row{"run.plan_ms",
                        median(ofThrows(result(), "plan_ms")),
                        "ms",
                        "none",
                        std::nullopt,
                        fmt::format("strategy {}, other processes idle, median of 3",
                                    result().at("strategy").get<std::string>())};
           }}};
}

}  // namespace fastball::bench
