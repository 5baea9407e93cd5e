#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "launch/commands.h"
#include "launch/processes.h"

namespace fastball::launch {
namespace {

struct BenchOptions {
  std::string filter = ".*";
  std::string json;
};

/// Becomes the program that measures, which the experiment does without: it is a third of a first
/// build. @throw std::runtime_error if it is not there.
[[noreturn]] void runBench(const BenchOptions& options) {
  const std::string program = programFolder() + "/fastball-bench";
  if (options.json.empty())
    execl(program.c_str(), program.c_str(), "--filter", options.filter.c_str(), nullptr);
  else
    execl(program.c_str(), program.c_str(), "--filter", options.filter.c_str(), "--json",
          options.json.c_str(), nullptr);
  throw std::runtime_error(fmt::format("{}: {}; `./fastball bench` in the source tree builds it",
                                       program,
                                       std::error_code(errno, std::generic_category()).message()));
}

}  // namespace

void addBenchCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("bench", "Measures the rows of the benchmark table");
  auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("--filter", options->filter, "Only rows whose id this regular expression finds")
      ->capture_default_str();
  command->add_option("--json", options->json, "File for the rows as one JSON object");
  command->callback([options] { runBench(*options); });
}

}  // namespace fastball::launch
