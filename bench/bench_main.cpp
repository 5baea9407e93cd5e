// The rows of the benchmark table, as `fastball bench` shows them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/row.h"
#include "launch/results.h"
#include "launch/run_setup.h"
#include "messaging/process.h"
#include "messaging/version.h"

namespace fastball::bench {
namespace {

std::regex parseFilter(const std::string& filter) {
  try {
    return std::regex(filter);
  } catch (const std::regex_error& e) {
    throw std::invalid_argument(
        fmt::format("--filter {}: not a regular expression: {}", filter, e.what()));
  }
}

/// @return exit status: a row that cannot be measured here does not cost the others.
int measure(const std::string& filter, const std::string& json) {
  const std::regex wanted = parseFilter(filter);
  if (!json.empty())
    launch::requireWritable("--json", json);
  std::vector<Row> rows;
  bool all = true;
  for (const Benchmark& benchmark : allBenchmarks()) {
    if (!std::regex_search(benchmark.id, wanted))
      continue;
    fmt::print(stderr, "measuring {}\n", benchmark.id);
    try {
      rows.push_back(benchmark.measure());
    } catch (const std::exception& e) {
      fmt::print(stderr, "fastball-bench: {} was not measured: {}\n", benchmark.id, e.what());
      all = false;
    }
  }
  if (rows.empty() && all)
    throw std::invalid_argument(fmt::format("--filter {}: no row has such an id", filter));
  fmt::print("{}", tableText(rows));
  if (!json.empty())
    launch::writeJson(toJson(rows), json);
  return all ? messaging::kExitDone : messaging::kExitFailed;
}

int run(int argc, char** argv) {
  CLI::App app{"Measures the rows of the benchmark table, each beside a peer or bound.",
               "fastball-bench"};
  app.set_version_flag("--version", std::string("fastball-bench ") + messaging::version());
  std::string filter = ".*", json;
  app.add_option("--filter", filter, "Only rows whose id this regular expression finds")
      ->capture_default_str();
  app.add_option("--json", json, "File for the rows as one JSON object");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? messaging::kExitDone : messaging::kExitUsage;
  }
  return measure(filter, json);
}

}  // namespace
}  // namespace fastball::bench

int main(int argc, char** argv) {
  try {
    return fastball::bench::run(argc, argv);
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "fastball-bench: {}\n", e.what());
    return fastball::messaging::kExitUsage;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fastball-bench: {}\n", e.what());
    return fastball::messaging::kExitFailed;
  }
}
