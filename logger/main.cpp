#include <CLI/CLI.hpp>

#include "config/experiment.h"
#include "logger/node.h"
#include "logger/run_record.h"
#include "messaging/process.h"
#include "messaging/version.h"

int main(int argc, char** argv) {
  using namespace fastball;
  std::string log_path = "fastball.lcmlog";
  logger::RunRecord record;
  record.version = messaging::version();
  return messaging::processMain(
      argc, argv, "logger",
      "Writes every message to an LCM log file, and beside it what the run was.",
      [&](messaging::LcmEndpoint& endpoint, const messaging::Clock& clock,
          const messaging::ProcessOptions& options) {
        auto node = logger::makeNode(endpoint, clock, log_path);
        record.config_path = config::experimentPath(options.config);
        logger::writeRunRecord(log_path, record, clock.wallUs());
        return node;
      },
      [&](CLI::App& app) {
        app.add_option("--log", log_path, "Log file to write")->capture_default_str();
        app.add_option("--seed", record.seed, "Seed of the run, for the record beside the log");
        app.add_option("--command-line", record.command_line,
                       "Command line of the run, for the record beside the log");
      });
}
