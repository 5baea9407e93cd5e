#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "launch/campaign/campaign_report.h"
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
      "report",
      "Draw the throws of a log, or the hits of a campaign (PNG and SVG), with tables (CSV)");
  command->add_option("LOG", options->log, "LCM log file of a run, or folder of a campaign")
      ->required();
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--config", options->config, "Experiment file (default: the shipped one)");
  command->callback([options, &exit_status] {
    const auto failures =
        std::filesystem::is_directory(options->log)
            ? writeCampaignReport(options->log, options->folder)
            : writeReport(options->log,
                          config::loadExperiment(config::experimentPath(options->config)),
                          options->folder);
    for (const std::string& failure : failures)
      std::cerr << failure << '\n';
    std::cout << "wrote " << options->folder << '\n';
    exit_status = failures.empty() ? messaging::kExitDone : messaging::kExitFailed;
  });
}

}  // namespace fastball::launch
