#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

#include "bench/row.h"
#include "launch/commands.h"
#include "launch/results.h"
#include "launch/run_setup.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

struct BenchOptions {
  std::string filter = ".*";
  std::string json;
};

std::regex parseFilter(const std::string& filter) {
  try {
    return std::regex(filter);
  } catch (const std::regex_error& e) {
    throw std::invalid_argument(
        fmt::format("--filter {}: not a regular expression: {}", filter, e.what()));
  }
}

int runBench(const BenchOptions& options) {
  const std::regex filter = parseFilter(options.filter);
  if (!options.json.empty())
    requireWritable("--json", options.json);
  std::vector<bench::Row> rows;
  for (const bench::Benchmark& benchmark : bench::allBenchmarks()) {
    if (!std::regex_search(benchmark.id, filter))
      continue;
    fmt::print(stderr, "measuring {}\n", benchmark.id);
    rows.push_back(benchmark.measure());
  }
  if (rows.empty()) {
    throw std::invalid_argument(fmt::format("--filter {}: no row has such an id", options.filter));
  }
  fmt::print("{}", bench::tableText(rows));
  if (!options.json.empty())
    writeJson(bench::toJson(rows), options.json);
  return messaging::kExitDone;
}

}  // namespace

void addBenchCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("bench", "Measures the rows of the benchmark table");
  auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("--filter", options->filter, "Only rows whose id this regular expression finds")
      ->capture_default_str();
  command->add_option("--json", options->json, "File for the rows as one JSON object");
  command->callback([options, &exit_status] { exit_status = runBench(*options); });
}

}  // namespace fastball::launch
