#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "messaging/lcm_endpoint.h"

namespace fastball::system_test {

/// How a `fastball` ended.
struct Outcome {
  int exit_status = -1;  ///< 128 + signal if one ended it
  std::string output;    ///< stdout and stderr
  nlohmann::json json;   ///< what it wrote to the file of --json; null: nothing
};

/// The real `fastball` with all its processes, in a folder of its own. Nobody else hears its network: the tests run in a network
/// namespace, and on a port that depends on the process id where there is none.
class FastballRun {
 public:
  /// Starts it. With the subcommand `run`, the flags --lcm-url, --log and --json are added where `arguments` has none of
  /// them. `wrapper`: words in front of the command, such as {"unshare", "-n"}.
  explicit FastballRun(std::vector<std::string> arguments,
                       const std::vector<std::string>& wrapper = {});
  ~FastballRun();
  FastballRun(const FastballRun&) = delete;
  FastballRun& operator=(const FastballRun&) = delete;

  /// Waits until it ends.
  Outcome wait();
  void signal(int number) const;
  int pid() const;
  /// Process ids of the programs it has started, by program name ("fastball-planner").
  std::map<std::string, int> children() const;
  /// Listens on the run's network with what `subscribe` subscribes to, until one of its handlers has set `reached`.
  /// @return false if the run ended before.
  bool await(const std::function<void(messaging::LcmEndpoint&, bool& reached)>& subscribe) const;
  /// Waits until the arm swings in the first throw that this test hears of.
  void awaitSwing() const;
  /// Waits until a process called `name` says HEARTBEAT.
  void awaitHeartbeat(const std::string& name) const;
  std::string lcmUrl() const { return url_; }
  std::string logPath() const { return folder_ + "/run.lcmlog"; }
  bool running() const;

 private:
  struct Impl;
  std::string folder_, url_;
  std::unique_ptr<Impl> impl_;
};

/// Runs it from start to end.
Outcome fastball(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& wrapper = {});

/// True while the process exists and is no zombie.
bool isRunning(int pid);

/// The folder `config` of the source tree, copied, with one text replaced by another in its file `file`. Deleted with this object.
class EditedConfig {
 public:
  EditedConfig(const std::string& file, const std::string& from, const std::string& to);
  ~EditedConfig();
  EditedConfig(const EditedConfig&) = delete;
  EditedConfig& operator=(const EditedConfig&) = delete;
  std::string experiment() const { return folder_ + "/experiment.yaml"; }

 private:
  std::string folder_;
};

}  // namespace fastball::system_test
