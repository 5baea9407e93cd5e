#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/library_versions.h"
#include "messaging/process.h"
#include "messaging/version.h"

namespace {

using fastball::messaging::kExitDone;
using fastball::messaging::kExitFailed;
using fastball::messaging::kExitUsage;

int fastballMain(int argc, char** argv) {
  CLI::App app{"A robot arm throws a ball into a net by the kinetic chain, as processes over LCM.",
               "fastball"};
  app.set_version_flag("--version", fmt::format("fastball {}\n{}", fastball::messaging::version(),
                                                fastball::launch::libraryVersions()));
  app.require_subcommand(0, 1);
  int exit_status = kExitDone;
  fastball::launch::addRunCommand(app, exit_status);
  fastball::launch::addCampaignCommand(app, exit_status);
  fastball::launch::addSystemCommands(app, exit_status);
  fastball::launch::addDoctorCommand(app, exit_status);
  fastball::launch::addViewCommand(app, exit_status);
  fastball::launch::addSpyCommand(app, exit_status);
  fastball::launch::addLogCommand(app, exit_status);
  fastball::launch::addReplayCommand(app, exit_status);
  fastball::launch::addKeyCommand(app, exit_status);
  fastball::launch::addReportCommand(app, exit_status);
  fastball::launch::addCalibrateCommand(app, exit_status);
  fastball::launch::addTrackCommand(app, exit_status);
  fastball::launch::addAtlasCommand(app, exit_status);
  fastball::launch::addFiguresCommand(app, exit_status);
  fastball::launch::addBenchCommand(app, exit_status);
  fastball::launch::addDocsCommand(app, exit_status);
  fastball::launch::addManualCommand(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kExitDone : kExitUsage;
  }
  if (app.get_subcommands().empty()) {
    fmt::print(stderr, "{}", app.help());
    return kExitUsage;
  }
  return exit_status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return fastballMain(argc, argv);
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "fastball: {}\n", e.what());
    return kExitUsage;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fastball: {}\n", e.what());
    return kExitFailed;
  }
}
