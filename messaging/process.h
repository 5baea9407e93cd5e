#pragma once

#include <functional>
#include <memory>
#include <string>

#include "messaging/clock.h"
#include "messaging/endpoint.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/node.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

namespace fastball::messaging {

/// Exit status of every program of the experiment.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/// What all processes take from the command line.
struct ProcessOptions {
  std::string lcm_url = kDefaultLcmUrl;
  std::string config;  ///< experiment file
  std::string key;  ///< file of the key that commands carry (messaging/command_key.h), empty: none
  bool realtime = false;    ///< paced by the wall clock, else in lockstep
  std::string uncertainty;  ///< file of errors to inject; only the simulator reads it
  bool images = true;       ///< false: no cameras and no tracker; the simulator says LANDING itself
  bool one_thread =
      false;  ///< the simulator draws images itself, with none of the threads that the experiment file gives it
  bool verbose = false;
  double silence_limit = 0;  ///< [s], 0: none (messaging/peer_watch.h)
  double duration_s = 0;     ///< end after this wall time, 0: run until told to stop
};

/// Runs a node over LCM until SIGINT or SIGTERM, node.finished(), or duration_s: waits on the file descriptor until a
/// message comes or a wake time is reached, drains, steps, says the HEARTBEAT. Ends with node.shutDown() and a last
/// HEARTBEAT. With a silence limit [s] it says HEARTBEAT that much faster, and tells the node, standard error and the
/// others who has fallen silent and who is back. Whoever asks on CLOCK what time it is gets an answer.
/// @return kExitDone, or kExitFailed if the node finished in state "failed".
/// @throw what the node or the network threw, after a last HEARTBEAT that says so and
///   node.shutDown().
int runOverLcm(Node& node,
               LcmEndpoint& endpoint,
               const Clock& clock,
               double duration_s = 0,
               double silence_limit = 0);

/// The key in a file, or null where no file is named.
/// @throw std::invalid_argument as CommandKey::read().
std::shared_ptr<const CommandKey> keyOf(const std::string& path);

/// The help text of `--key`.
inline constexpr const char* kKeyHelp =
    "File of the key that commands must carry (made by 'fastball key'), the same for all "
    "processes; default: none";

/// Builds a process's node on its endpoint. Endpoint and clock outlive the node.
using MakeNode =
    std::function<std::unique_ptr<Node>(LcmEndpoint&, const Clock&, const ProcessOptions&)>;
/// Adds a process's own flags, read into variables that its MakeNode captures.
using AddFlags = std::function<void(CLI::App&)>;
/// The main() of every process: parses flags (CLI11; `--lcm-url --config --key --realtime --verbose
/// --duration --silence-limit --version`), connects, prints one line (name, version, URL), builds
/// the node, runs it, and turns exceptions into one sentence on stderr and an exit status (2 for
/// std::invalid_argument, of which config::ConfigError is one, and for wrong flags; else 1). Its
/// log goes to stderr.
int processMain(int argc,
                char** argv,
                const std::string& name,
                const std::string& description,
                const MakeNode& make_node,
                const AddFlags& add_flags = {});

}  // namespace fastball::messaging
