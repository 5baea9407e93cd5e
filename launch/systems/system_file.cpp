#include "launch/systems/system_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "config/strict_yaml.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {
namespace {

using config::Section;

constexpr const char* kHere = "here";
// Of a system on several machines. Simulated time comes in messages; what is dated by clocks of several machines are
// HEARTBEATs, and their order must be that in which they were said: half of the time between two. Real cameras need less.
constexpr double kClockLimit = 0.05;  // [s]
// Of a system on several machines. A HEARTBEAT every 100 ms is then 5 kB/s for the whole experiment, and four in a row are not
// lost by chance.
constexpr double kSilenceLimit = 0.5;  // [s]
constexpr double kShortestLimit =
    0.1;  // [s], five beats of 20 ms: processes are not always served sooner
// A link that is cut must be noticed: ssh itself asks once a second.
const std::vector<std::string> kSsh = {"ssh", "-T",
                                       "-o",  "BatchMode=yes",
                                       "-o",  "ConnectTimeout=5",
                                       "-o",  "ServerAliveInterval=1",
                                       "-o",  "ServerAliveCountMax=3"};

std::string textOr(Section& section, const std::string& key, const std::string& otherwise) {
  return section.has(key) ? section.text(key) : otherwise;
}

std::map<std::string, Host> readHosts(Section& file) {
  std::map<std::string, Host> hosts;
  hosts[kHere].name = kHere;
  if (!file.has("hosts"))
    return hosts;
  for (Section& section : file.sections("hosts")) {
    Host host;
    host.name = section.text("name");
    host.address = textOr(section, "address", host.name == kHere ? "" : host.name);
    host.folder = textOr(section, "folder", "");
    host.work_folder = textOr(section, "work_folder", "");
    host.ssh = section.has("ssh") ? section.texts("ssh") : kSsh;
    section.finish();
    if (host.ssh.empty())
      throw section.error("ssh", "must name a program");
    if (host.name == kHere && !host.isHere())
      throw section.error("address", "must not be given for this machine, 'here'");
    if (host.name != kHere && hosts.count(host.name) != 0)
      throw section.error("name", fmt::format("is '{}', as that of another host", host.name));
    hosts[host.name] = host;
  }
  return hosts;
}

void readEnvironment(Section& section, SystemProcess& process) {
  if (!section.has("environment"))
    return;
  process.environment = section.texts("environment");
  for (const std::string& entry : process.environment)
    if (entry.find('=') == std::string::npos || entry.front() == '=')
      throw section.error("environment", fmt::format("has '{}', must be KEY=VALUE", entry));
}

void readCpus(Section& section, SystemProcess& process) {
  if (!section.has("cpus"))
    return;
  const Eigen::VectorXd cpus = section.vector("cpus", -1, {0, 1023});
  for (const double cpu : cpus) {
    if (cpu != static_cast<int>(cpu))
      throw section.error("cpus", fmt::format("has {}, must be whole numbers", cpu));
    process.cpus.push_back(static_cast<int>(cpu));
  }
}

SystemProcess readProcess(Section& section, const std::map<std::string, Host>& hosts) {
  SystemProcess process;
  process.name = section.text("name");
  const std::string host = textOr(section, "host", kHere);
  if (hosts.count(host) == 0)
    throw section.error("host", fmt::format("is '{}', which is not among the hosts", host));
  process.host = hosts.at(host);
  process.command = section.texts("command");
  if (process.command.empty())
    throw section.error("command", "must name a program");
  readEnvironment(section, process);
  if (section.has("restart") && section.choice("restart", {"never", "on_failure"}) != "never")
    process.restart = Restart::kOnFailure;
  if (section.has("most_restarts"))
    process.most_restarts = section.integer("most_restarts", 0, 1000000);
  if (section.has("ready_when") &&
      section.choice("ready_when", {"heartbeat", "started"}) == "started")
    process.ready_when = ReadyWhen::kStarted;
  if (section.has("ready_timeout"))
    process.ready_timeout = section.number("ready_timeout", {0.1, 3600});
  if (section.has("stop_signal"))
    process.stop_signal = section.choice("stop_signal", {"INT", "TERM", "HUP", "QUIT"});
  if (section.has("grace"))
    process.grace = section.number("grace", {0, 3600});
  if (section.has("realtime_priority"))
    process.realtime_priority = section.integer("realtime_priority", 1, 99);
  readCpus(section, process);
  section.finish();
  return process;
}

/// Where all processes are on one machine their launcher sees them end, and no cable can be cut.
void readSilenceLimit(Section& file, System& system) {
  system.silence_limit = system.isOnOneMachine() ? 0 : kSilenceLimit;
  if (file.has("silence_limit"))
    system.silence_limit = file.number("silence_limit", {0, 60});
  if (system.silence_limit > 0 && system.silence_limit < kShortestLimit)
    throw file.error("silence_limit", fmt::format("is {} s, must be 0 (none) or at least {} s",
                                                  system.silence_limit, kShortestLimit));
  if (system.silence_limit == 0)
    return;
  for (SystemProcess& process : system.processes)
    process.environment.insert(process.environment.begin(),
                               fmt::format("FASTBALL_SILENCE_LIMIT={}", system.silence_limit));
}

}  // namespace

bool System::has(const std::string& process) const {
  return std::any_of(processes.begin(), processes.end(),
                     [&](const SystemProcess& one) { return one.name == process; });
}

bool System::isOnOneMachine() const {
  return std::all_of(processes.begin(), processes.end(),
                     [](const SystemProcess& process) { return process.host.isHere(); });
}

System loadSystem(const std::string& path) {
  Section file = Section::fromFile(path);
  System system;
  system.path = std::filesystem::canonical(path).string();
  system.lcm_url = textOr(file, "lcm_url", messaging::defaultLcmUrl());
  const auto hosts = readHosts(file);
  std::set<std::string> names;
  for (Section& section : file.sections("processes")) {
    system.processes.push_back(readProcess(section, hosts));
    if (!names.insert(system.processes.back().name).second)
      throw section.error(
          "name", fmt::format("is '{}', as that of another process", system.processes.back().name));
  }
  readSilenceLimit(file, system);
  system.clock_limit = file.has("clock_limit")   ? file.number("clock_limit", {0, 3600})
                       : system.isOnOneMachine() ? 0
                                                 : kClockLimit;
  file.finish();
  if (system.processes.empty())
    throw file.error("processes", "must name a process");
  if (!system.isOnOneMachine() && system.lcm_url.find("ttl=0") != std::string::npos)
    throw file.error("lcm_url", fmt::format("is '{}': with ttl=0 no message leaves a machine, and "
                                            "there are processes on several; give ttl=1",
                                            system.lcm_url));
  return system;
}

}  // namespace fastball::launch
