#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "launch/commands.h"
#include "launch/recorded_configuration.h"
#include "launch/replay.h"
#include "launch/replay_console.h"
#include "launch/replay_rerun.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

struct Options {
  std::string log, rerun, config, key;
  std::string lcm_url = messaging::defaultLcmUrl();
  std::vector<std::string> names;
  ReplayOptions replay;
};

int runAgain(const Options& options) {
  const RecordedConfiguration configuration(options.log, options.config);
  const auto channels = rerun(options.rerun, options.log, configuration.experiment());
  int64_t recorded = 0, equal = 0;
  for (const auto& [name, channel] : channels) {
    std::cout << comparisonLine(name, channel) << '\n';
    recorded += channel.recorded;
    equal += channel.equal;
  }
  std::cout << fmt::format("{} of {} messages of the {} equal, in all fields but seq and plan_ms\n",
                           equal, recorded, options.rerun);
  return equal == recorded ? messaging::kExitDone : messaging::kExitFailed;
}

/// "ARM_STATE=OLD_ARM_STATE" and so on.
std::map<std::string, std::string> namePairs(const std::vector<std::string>& pairs) {
  std::map<std::string, std::string> names;
  for (const std::string& pair : pairs) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size())
      throw std::invalid_argument(
          fmt::format("--remap takes RECORDED=SAID, two names of channels, not '{}'", pair));
    names[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return names;
}

int sayAgain(Options& options) {
  options.replay.names = namePairs(options.names);
  messaging::LcmEndpoint endpoint(options.lcm_url, messaging::keyOf(options.key), "replay");
  TerminalConsole console(options.replay.paused);
  const int64_t said = replayLog(options.log, options.replay, endpoint, console);
  console.line(fmt::format("replayed {} messages on {}{}", said, endpoint.url(),
                           console.stopped() ? ", stopped before the end" : ""));
  return endpoint.unsent() == 0 ? messaging::kExitDone : messaging::kExitFailed;
}

void addFlags(CLI::App& command, Options& options) {
  command.add_option("LOG", options.log, "LCM log file")->required();
  command.add_option("--from", options.replay.part.from, "Seconds from the first message")
      ->capture_default_str();
  command.add_option("--to", options.replay.part.to, "Seconds from the first message");
  command.add_option("--speed", options.replay.speed, "Times real time")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command.add_option("--channel", options.replay.part.channels, "Only channels that match this")
      ->option_text("REGEX");
  command.add_option("--exclude", options.replay.part.excluded, "No channel that matches this")
      ->option_text("REGEX");
  command.add_option("--remap", options.names, "Say a channel under another name; may be repeated")
      ->option_text("RECORDED=SAID")
      ->expected(1)
      ->take_all();
  command.add_flag("--pause", options.replay.paused,
                   "Begin paused; the space bar goes on and pauses");
  command.add_flag("--commands", options.replay.commands,
                   "Replay also the channels that make a robot move");
  command
      .add_option("--key", options.key,
                  "File of the key that commands must carry (made by 'fastball key')")
      ->option_text("FILE");
  command
      .add_option("--rerun", options.rerun,
                  "Feed the recorded input to this process and compare all that it says")
      ->check(CLI::IsMember(rerunProcesses()));
  command.add_option(
      "--config", options.config,
      "Experiment file of the process run again; default: that recorded with the log");
  command.add_option("--lcm-url", options.lcm_url, "Where to say the messages")
      ->capture_default_str();
}

}  // namespace

void addReplayCommand(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "replay", "Say the messages of a log again, or feed them to a process and compare");
  addFlags(*command, *options);
  command->callback([options, &exit_status] {
    exit_status = options->rerun.empty() ? sayAgain(*options) : runAgain(*options);
  });
}

}  // namespace fastball::launch
