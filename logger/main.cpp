#include <CLI/CLI.hpp>
#include <csignal>

#include "config/experiment.h"
#include "logger/node.h"
#include "logger/run_record.h"
#include "messaging/process.h"
#include "messaging/version.h"

namespace {

constexpr double kMega = 1e6;

}  // namespace

int main(int argc, char** argv) {
  using namespace fastball;
  logger::LoggerOptions logging;
  logging.recorder.path = "fastball.lcmlog";
  double buffer_mb = 256, split_mb = 0, split_s = 0;
  // A file at its size limit is a full disk, not a reason to die.
  std::signal(SIGXFSZ, SIG_IGN);
  logger::RunRecord record;
  record.version = messaging::version();
  return messaging::processMain(
      argc, argv, "logger",
      "Writes every message to an LCM log file, and beside it what the run was.",
      [&](messaging::LcmEndpoint& endpoint, const messaging::Clock& clock,
          const messaging::ProcessOptions& options) {
        logging.recorder.buffer_bytes = static_cast<std::size_t>(buffer_mb * kMega);
        logging.recorder.split_bytes = static_cast<int64_t>(split_mb * kMega);
        logging.recorder.split_us = static_cast<int64_t>(split_s * kMega);
        auto node = logger::makeNode(endpoint, clock, logging);
        record.config_path = config::experimentPath(options.config);
        logger::writeRunRecord(logging.recorder.path, record, clock.wallUs());
        return node;
      },
      [&](CLI::App& app) {
        app.add_option("--log", logging.recorder.path, "Log file to write")->capture_default_str();
        app.add_option("--channel", logging.channels, "Log only channels that match this")
            ->option_text("REGEX");
        app.add_option("--exclude", logging.excluded, "Log no channel that matches this")
            ->option_text("REGEX");
        app.add_option("--buffer-mb", buffer_mb,
                       "Memory for messages that wait for a slow or full disk")
            ->check(CLI::Range(1.0, 1e5))
            ->capture_default_str();
        app.add_option("--split-mb", split_mb,
                       "Begin a new file before one gets longer; LOG.lcmlog becomes LOG.000.lcmlog")
            ->check(CLI::Range(0.001, 1e9));
        app.add_option("--split-s", split_s, "Begin a new file when one spans this time")
            ->check(CLI::Range(0.01, 1e9));
        app.add_option("--keep", logging.recorder.keep,
                       "Keep only so many of these files, the newest")
            ->check(CLI::Range(1, 1000000));
        app.add_option("--seed", record.seed, "Seed of the run, for the record beside the log");
        app.add_option("--command-line", record.command_line,
                       "Command line of the run, for the record beside the log");
      });
}
