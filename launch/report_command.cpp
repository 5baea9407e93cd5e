#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "launch/commands.h"
#include "launch/report.h"
#include "messaging/process.h"

namespace fastball::launch {

void addReportCommand(CLI::App& app, int& exit_status) {
  struct Options {
    std::string log, folder, config;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "report", "Draw the throws of a log (PNG and SVG) and write them as a table (CSV)");
  command->add_option("LOG", options->log, "LCM log file of a run")->required();
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--config", options->config, "Experiment file (default: the shipped one)");
  command->callback([options, &exit_status] {
    const std::string path = config::experimentPath(options->config);
    const auto failures = writeReport(options->log, config::loadExperiment(path), options->folder);
    for (const std::string& failure : failures)
      std::cerr << failure << '\n';
    std::cout << "wrote " << options->folder << '\n';
    exit_status = failures.empty() ? messaging::kExitDone : messaging::kExitFailed;
  });
}

}  // namespace fastball::launch
