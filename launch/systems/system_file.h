#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// A machine on which processes of a system run.
struct Host {
  std::string name;
  std::string address;      ///< for ssh, as the user's ~/.ssh/config knows it; empty: this machine
  std::string folder;       ///< of the programs there; empty: where this program lies
  std::string work_folder;  ///< in which the processes start; empty: the present one, or ssh's
  std::vector<std::string> ssh{};  ///< the command up to the address

  bool isHere() const { return address.empty(); }
};

/// What is done when a process ends by itself.
enum class Restart { kNever, kOnFailure };
/// What makes a process ready.
enum class ReadyWhen { kHeartbeat, kStarted };

/// A process of a system.
struct SystemProcess {
  std::string name;  ///< also that of its HEARTBEAT
  Host host;
  std::vector<std::string>
      command;  ///< a program without '/' is beside `fastball`, else on the PATH
  std::vector<std::string> environment;  ///< "KEY=VALUE"
  Restart restart = Restart::kNever;
  int most_restarts = 5;
  ReadyWhen ready_when = ReadyWhen::kHeartbeat;
  double ready_timeout = 20;  ///< [s]
  std::string stop_signal = "INT";
  double grace = 2;           ///< [s], from the stop signal to KILL
  int realtime_priority = 0;  ///< of SCHED_FIFO, 0: none
  std::vector<int> cpus;      ///< on which it may run; empty: all
};

/// What `fastball up` starts.
struct System {
  std::string path;     ///< of its file, absolute
  std::string lcm_url;  ///< every process gets it as FASTBALL_LCM_URL
  /// [s], how soon the processes and a run on them notice that one is silent; 0: never. Every process gets it as
  /// FASTBALL_SILENCE_LIMIT.
  double silence_limit = 0;
  double clock_limit =
      0;  ///< [s], between the launcher's clock and that of another machine; 0: not measured
  std::vector<SystemProcess> processes;

  bool isOnOneMachine() const;
  bool has(const std::string& process) const;
};

/// @throw config::ConfigError that names file, line and key.
System loadSystem(const std::string& path);

}  // namespace fastball::launch
