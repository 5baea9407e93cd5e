#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "launch/atlas_setup.h"
#include "launch/commands.h"
#include "launch/local_run.h"
#include "launch/network_run.h"
#include "launch/run_setup.h"
#include "messaging/version.h"
#include "planner/atlas_file.h"

namespace fastball::launch {
namespace {

constexpr int kMostThrows = 1000000;

void announce(const RunSetup& setup, Progress& progress) {
  progress.line(fmt::format(
      "fastball {}: {} throw{}, strategy {}, seed {}, arm {}{}", messaging::version(),
      setup.settings.throws, setup.settings.throws == 1 ? "" : "s", setup.settings.strategy,
      setup.settings.seed, setup.arm, setup.options.realtime ? ", in real time" : ""));
  if (setup.on_system)
    progress.line("by the processes on " + setup.options.lcm_url);
  else
    progress.line(setup.log.empty() ? "one process, no network, no log" : "log " + setup.log);
}

int conduct(const RunOptions& options, RunResult& result) {
  const RunSetup setup = prepareRun(options);
  result.strategy = setup.settings.strategy;
  result.arm = setup.arm;
  result.log = setup.log;
  Progress progress;
  announce(setup, progress);
  ensureAtlas(planner::loadConfig(setup.options.config), planner::atlasFolder(), false, progress);
  if (options.no_network) {
    runInOneProcess(setup, progress, result);
  } else {
    runOverNetwork(setup, progress, result);
  }
  if (!result.error.empty())
    throw std::runtime_error(result.error);
  progress.line(fmt::format("{} of {} in the net", result.hits(), result.throws.size()));
  return messaging::kExitDone;
}

/// The words with which this program was started.
std::string commandLine() {
  std::ifstream file("/proc/self/cmdline");
  std::string words{std::istreambuf_iterator<char>(file), {}};
  if (!words.empty())
    words.pop_back();
  std::replace(words.begin(), words.end(), '\0', ' ');
  return words;
}

/// Conducts the run and writes its JSON object, also that of a run which failed.
int run(const RunOptions& options) {
  RunResult result;
  result.version = messaging::version();
  result.seed = options.seed;
  result.strategy = options.strategy;
  try {
    const int status = conduct(options, result);
    if (!options.json.empty())
      writeJson(toJson(result), options.json);
    return status;
  } catch (const std::exception& e) {
    result.error = e.what();
    if (!options.json.empty()) {
      try {
        writeJson(toJson(result), options.json);
      } catch (const std::exception& unwritten) {
        fmt::print(stderr, "fastball: {}\n", unwritten.what());
      }
    }
    throw;
  }
}

}  // namespace

void addRunCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "run", "Makes throws: starts all processes, conducts, judges, leaves an LCM log");
  auto options = std::make_shared<RunOptions>();
  options->lcm_url = messaging::defaultLcmUrl();
  command->add_option("--throws", options->throws, "How many throws")
      ->check(CLI::Range(1, kMostThrows))
      ->capture_default_str();
  command
      ->add_option("--seed", options->seed,
                   "Of everything random; the same seed gives the same run")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--strategy", options->strategy,
                   "How the throw is planned (default: run.strategy of the experiment file)")
      ->check(CLI::IsMember(kStrategies));
  command->add_option("--config", options->config,
                      "Experiment file (default: config/experiment.yaml)");
  command->add_option("--uncertainty", options->uncertainty,
                      "File of errors that the simulator injects (default: none)");
  CLI::Option* learned = command->add_option(
      "--learned", options->learned,
      "File that strategy adaptive keeps what it learns in, across runs; delete it to "
      "begin anew (default: it begins anew in every run)");
  CLI::Option* log = command->add_option(
      "--log", options->log, "LCM log to write (default: runs/<time>-seed<seed>.lcmlog)");
  command->add_option("--json", options->json, "File for the results as one JSON object");
  CLI::Option* realtime = command->add_flag("--realtime", options->realtime,
                                            "Pace by the clock instead of in lockstep");
  CLI::Option* url = command->add_option("--lcm-url", options->lcm_url, "Where the processes meet")
                         ->capture_default_str();
  CLI::Option* key =
      command->add_option("--key", options->key, messaging::kKeyHelp)->option_text("FILE");
  CLI::Option* uncertainty = command->get_option("--uncertainty");
  CLI::Option* no_images =
      command->add_flag("--no-images", options->no_images,
                        "No cameras and no tracker: a light curtain in the ring measures landings");
  command
      ->add_option("--system", options->system,
                   "Throw with the processes that 'fastball up FILE' has started")
      ->excludes(log)
      ->excludes(realtime)
      ->excludes(uncertainty)
      ->excludes(learned)
      ->excludes(no_images)
      ->excludes(url);
  command
      ->add_flag("--no-network", options->no_network,
                 "The same parts in one process: no LCM, no log, the same throws")
      ->excludes(log)
      ->excludes(realtime)
      ->excludes(url)
      ->excludes(key);
  command->callback([options, &exit_status] {
    options->command_line = commandLine();
    exit_status = run(*options);
  });
}

}  // namespace fastball::launch
