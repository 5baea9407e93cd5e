#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "launch/campaign/campaign_report.h"
#include "launch/commands.h"
#include "launch/report/report.h"
#include "messaging/process.h"

namespace fastball::launch {

void addReportCommand(CLI::App& app, int& exit_status) {
  struct Options {
    std::string log, folder, config;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("report",
                                         "A page (HTML) of the throws of a log, or of the hits of "
                                         "a campaign, with its pictures (PNG and "
                                         "SVG) and tables (CSV)");
  command->add_option("LOG", options->log, "LCM log file of a run, or folder of a campaign")
      ->required();
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option(
      "--config", options->config,
      "Experiment file (default: that recorded with the log, or else the shipped one)");
  command->callback([options, &exit_status] {
    const ReportOutcome outcome =
        std::filesystem::is_directory(options->log)
            ? ReportOutcome{true, writeCampaignReport(options->log, options->folder)}
            : writeReport(options->log, options->config, options->folder);
    for (const std::string& sentence : outcome.missing)
      std::cerr << options->log << ": " << sentence << '\n';
    std::cout << "wrote " << options->folder << "/index.html\n";
    exit_status = !outcome.holds_messages   ? messaging::kExitUsage
                  : outcome.missing.empty() ? messaging::kExitDone
                                            : messaging::kExitFailed;
  });
}

}  // namespace fastball::launch
