#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/figures/figure.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

struct FiguresOptions {
  std::string folder, config, only = ".*";
};

std::regex parseOnly(const std::string& only) {
  try {
    return std::regex(only);
  } catch (const std::regex_error& e) {
    throw std::invalid_argument(
        fmt::format("--only {}: not a regular expression: {}", only, e.what()));
  }
}

int drawFigures(const FiguresOptions& options) {
  FigureTask task;
  task.config = config::experimentPath(options.config);
  task.experiment = config::loadExperiment(task.config);
  task.folder = options.folder;
  writeFigures(task, parseOnly(options.only), [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  });
  fmt::print("wrote {}\n", options.folder);
  return messaging::kExitDone;
}

}  // namespace

void addFiguresCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "figures", "Computes and draws the figures of the method (PNG, SVG, CSV, captions)");
  auto options = std::make_shared<FiguresOptions>();
  command->add_option("-o,--output", options->folder, "Folder to write to")->required();
  command->add_option("--config", options->config, "Experiment file (default: the shipped one)");
  command
      ->add_option("--only", options->only, "Only figures whose name this regular expression finds")
      ->capture_default_str();
  command->callback([options, &exit_status] { exit_status = drawFigures(*options); });
}

}  // namespace fastball::launch
