#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "config/experiment.h"
#include "launch/commands.h"
#include "launch/replay.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

struct Options {
  std::string log, rerun, config;
  std::string lcm_url = messaging::defaultLcmUrl();
  ReplayOptions replay;
};

int rerun(const Options& options) {
  const std::string config = config::experimentPath(options.config);
  const auto landings = rerunTracker(options.log, config);
  for (const RerunLanding& landing : landings)
    std::cout << rerunLine(landing) << '\n';
  const auto equal = std::count_if(landings.begin(), landings.end(),
                                   [](const RerunLanding& landing) { return landing.equal; });
  std::cout << fmt::format("{} of {} landings equal\n", equal, landings.size());
  return equal == static_cast<std::ptrdiff_t>(landings.size()) ? messaging::kExitDone
                                                               : messaging::kExitFailed;
}

}  // namespace

void addReplayCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "replay", "Say the messages of a log again, or feed them to a process and compare");
  command->add_option("LOG", options->log, "LCM log file")->required();
  command->add_option("--speed", options->replay.speed, "Times real time")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--rerun", options->rerun,
                   "Feed the recorded input to this process and compare what it says")
      ->check(CLI::IsMember({"tracker"}));
  command->add_flag("--commands", options->replay.commands,
                    "Replay also the channels that make a robot move");
  command->add_option("--config", options->config, "Experiment file of the process run again");
  command->add_option("--lcm-url", options->lcm_url, "Where to say the messages")
      ->capture_default_str();
  command->callback([options, &exit_status] {
    if (!options->rerun.empty()) {
      exit_status = rerun(*options);
      return;
    }
    messaging::LcmEndpoint endpoint(options->lcm_url);
    const int64_t said = replayLog(options->log, options->replay, endpoint);
    std::cout << fmt::format("replayed {} messages on {}\n", said, endpoint.url());
    exit_status = messaging::kExitDone;
  });
}

}  // namespace fastball::launch
