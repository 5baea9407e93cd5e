#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "launch/commands.h"
#include "launch/systems/hold.h"
#include "launch/systems/launcher.h"
#include "messaging/process.h"

namespace fastball::launch {
namespace {

void printTable(const nlohmann::json& state) {
  fmt::print("{:<16} {:<10} {:<10} {:>8} {:>8} {:>9}  {}\n", "process", "host", "state", "pid",
             "restarts", "heartbeat", "says");
  for (const nlohmann::json& process : state.at("processes")) {
    const bool heard = process.contains("pid");
    std::string says = process.value("says", "");
    for (const char* key : {"detail", "note"}) {
      const std::string more = process.value(key, "");
      if (!more.empty())
        says += (says.empty() ? "" : ": ") + more;
    }
    fmt::print("{:<16} {:<10} {:<10} {:>8} {:>8} {:>9}  {}\n", process.value("name", ""),
               process.value("host", ""), process.value("state", ""),
               heard ? std::to_string(process.value("pid", 0)) : "-", process.value("restarts", 0),
               heard ? fmt::format("{:.1f} s", process.value("heartbeat_age_s", 0.0)) : "-", says);
  }
  fmt::print("on {}, launcher {}\n", state.value("lcm_url", ""), state.value("launcher", 0));
}

int up(const std::string& path, bool foreground) {
  const System system = loadSystem(path);
  StateFolder folder(system.path);
  if (folder.isLocked())
    throw std::runtime_error(fmt::format("{} is up already; see 'fastball ps'", system.path));
  if (foreground) {
    superviseHere(system, folder);
    return messaging::kExitDone;
  }
  superviseBehind(system, folder);
  fmt::print("{} processes are ready; 'fastball down' ends them, their output is in {}\n",
             system.processes.size(), folder.path());
  return messaging::kExitDone;
}

int down(const std::string& path) {
  const System system = loadSystem(path);
  const bool was_up = endLauncher(StateFolder(system.path), system);
  fmt::print("{} {}\n", system.path, was_up ? "is down" : "was not up");
  return messaging::kExitDone;
}

int list(const std::string& path, bool json) {
  const System system = loadSystem(path);
  const StateFolder folder(system.path);
  const auto state = folder.read();
  if (!state || !folder.isLocked()) {
    fmt::print(json ? "{{\"processes\": []}}\n" : "{} is not up\n", system.path);
    return messaging::kExitFailed;
  }
  if (json)
    fmt::print("{}\n", state->dump(2));
  else
    printTable(*state);
  return messaging::kExitDone;
}

}  // namespace

void addSystemCommands(CLI::App& app, int& exit_status) {
  struct Options {
    std::string file;
    bool foreground = false, json = false;
    HoldOptions hold;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "up", "Start the processes of a system on their machines; done when all are ready");
  command->add_option("FILE", options->file, "System file, as those in config/systems")->required();
  command->add_flag("--foreground", options->foreground,
                    "Stay, show all output, and end the system with this program");
  command->callback([=, &exit_status] { exit_status = up(options->file, options->foreground); });

  command = app.add_subcommand("down", "End the processes of a system");
  command->add_option("FILE", options->file, "System file")->required();
  command->callback([=, &exit_status] { exit_status = down(options->file); });

  command =
      app.add_subcommand("ps", "List the processes of a system (exit status 1: it is not up)");
  command->add_option("FILE", options->file, "System file")->required();
  command->add_flag("--json", options->json, "One JSON object");
  command->callback([=, &exit_status] { exit_status = list(options->file, options->json); });

  command = app.add_subcommand(
      "hold", "Run a program for as long as standard input stays open (what 'up' starts)");
  HoldOptions& hold_options = options->hold;
  command->add_option("--stop-signal", hold_options.stop_signal, "The signal that ends it")
      ->check(CLI::IsMember({"INT", "TERM", "HUP", "QUIT"}))
      ->capture_default_str();
  command->add_option("--grace", hold_options.grace, "Seconds from there to KILL")
      ->capture_default_str();
  command->add_option("--silence", hold_options.silence,
                      "Seconds without input after which it is ended (0: any number)");
  command->add_option("--environment", hold_options.environment, "KEY=VALUE, may be repeated")
      ->allow_extra_args(false);
  command->add_option("--realtime-priority", hold_options.realtime_priority, "Of SCHED_FIFO");
  command->add_option("--cpu", hold_options.cpus, "On which it may run, may be repeated")
      ->allow_extra_args(false);
  command->add_option("COMMAND", hold_options.command, "Program and its arguments")->required();
  command->positionals_at_end();
  command->callback([=, &exit_status] { exit_status = hold(options->hold); });
}

}  // namespace fastball::launch
