#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fastball::launch {

/// A program to run, and the name under which it says HEARTBEAT.
struct ProcessCommand {
  std::string name;
  std::string program;  ///< path
  std::vector<std::string> arguments;
};

/// Programs started and looked after: each in its own process group (a Ctrl-C at the terminal
/// reaches only this program), with its output kept. None is left when this object is gone, nor
/// when this program is killed.
class Processes {
 public:
  Processes();
  /// Stops what still runs, with no grace.
  ~Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  /// @throw std::runtime_error if the program cannot be started.
  void start(const ProcessCommand& command);
  /// Process id of the process called `name`; 0: none.
  int pid(const std::string& name) const;
  std::vector<std::string> names() const;
  /// A sentence on a process that has ended by itself ("controller was ended by signal 9
  /// (Killed)") with its lastOutput() in the lines below, or nothing.
  std::optional<std::string> ended();
  /// Exit status of a process that has ended, 128 + the signal's number if one ended it; -1 if it runs or is none of these.
  int exitStatus(const std::string& name);
  /// The last five lines that the process wrote to stdout and stderr, each with "[name] " in front.
  std::string lastOutput(const std::string& name) const;
  /// Ends all processes but those named `last` by SIGINT, after `grace` [s] by SIGKILL; then, with
  /// a grace of their own, those. Then none of them is known here any more.
  /// @return names of those that had to be killed.
  std::vector<std::string> stop(double grace, const std::string& last = "");

 private:
  struct Process;
  std::vector<std::string> stopSome(double grace, const std::vector<Process*>& some);
  std::vector<std::unique_ptr<Process>> processes_;
};

/// Folder of the running program, where its fellow programs lie.
std::string programFolder();

}  // namespace fastball::launch
