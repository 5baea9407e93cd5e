#include "launch/experiment_processes.h"

namespace fastball::launch {
namespace {

/// What only one of the processes is told.
std::vector<std::string> ownArguments(const std::string& name, const RunSetup& setup) {
  std::vector<std::string> own;
  if (name == kLogger) {
    own = {"--log",          setup.log,         "--seed", std::to_string(setup.settings.seed),
           "--command-line", setup.command_line};
  }
  if (name == "sim_bullet" && !setup.options.uncertainty.empty())
    own.insert(own.end(), {"--uncertainty", setup.options.uncertainty});
  if (hearsCommands(name) && setup.key)
    own.insert(own.end(), {"--key", setup.options.key});
  if (name == "sim_bullet" && !setup.options.images)
    own.emplace_back("--no-images");
  return own;
}

}  // namespace

bool hearsCommands(const std::string& name) {
  return name != kLogger;
}

std::vector<ProcessCommand> experimentProcesses(const RunSetup& setup) {
  std::vector<std::string> shared = {"--lcm-url", setup.options.lcm_url, "--config",
                                     setup.options.config};
  if (setup.options.realtime)
    shared.emplace_back("--realtime");
  const std::string folder = programFolder() + "/fastball-";
  std::vector<ProcessCommand> all = {{kLogger, folder + "logger", shared},
                                     {"planner", folder + "planner", shared},
                                     {"controller", folder + "controller", shared},
                                     {"hand_server", folder + "hand-server", shared},
                                     {"sim_bullet", folder + "sim-bullet", shared}};
  if (setup.options.images)
    all.push_back({"vision_tracker", folder + "vision-tracker", shared});
  for (ProcessCommand& command : all) {
    const std::vector<std::string> own = ownArguments(command.name, setup);
    command.arguments.insert(command.arguments.end(), own.begin(), own.end());
  }
  return all;
}

std::vector<std::string> namesOf(const std::vector<ProcessCommand>& all) {
  std::vector<std::string> names;
  for (const ProcessCommand& command : all)
    names.push_back(command.name);
  return names;
}

}  // namespace fastball::launch
