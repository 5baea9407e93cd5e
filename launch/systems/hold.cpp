#include "launch/systems/hold.h"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/env.hpp>
#include <boost/process/environment.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/group.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>

#include "launch/child_setup.h"
#include "launch/processes.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

namespace bp = boost::process;
using Steady = std::chrono::steady_clock;

constexpr int kLookMs = 20;

void placeOnCpus(const HoldOptions& options) {
  if (options.cpus.empty())
    return;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : options.cpus)
    CPU_SET(cpu, &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0)
    throw std::runtime_error(fmt::format("cannot run {} on the CPUs {}: {}",
                                         options.command.front(), fmt::join(options.cpus, ", "),
                                         std::strerror(errno)));
}

void setPriority(const HoldOptions& options) {
  if (options.realtime_priority == 0)
    return;
  const sched_param priority{options.realtime_priority};
  if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    throw std::runtime_error(fmt::format(
        "cannot give {} the real-time priority {}: {}; allow it with '@realtime - rtprio 99' in "
        "/etc/security/limits.d/ and membership of the group realtime",
        options.command.front(), options.realtime_priority, std::strerror(errno)));
}

int signalNumber(const std::string& name) {
  static const std::map<std::string_view, int> kNumbers{
      {"INT", SIGINT}, {"TERM", SIGTERM}, {"HUP", SIGHUP}, {"QUIT", SIGQUIT}};
  return kNumbers.at(name);
}

/// Whoever holds standard input open.
class Holder {
 public:
  explicit Holder(double silence) : silence_(silence) {}

  /// Waits a little. False once there is nobody, or nobody who says anything; `why` says which.
  bool isThere(std::string* why) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, kLookMs) > 0) {
      std::array<char, 256> bytes{};
      const ssize_t got = read(STDIN_FILENO, bytes.data(), bytes.size());
      if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) {
        *why = "the launcher is gone";
        return false;
      }
      heard_ = Steady::now();
    }
    const std::chrono::duration<double> quiet = Steady::now() - heard_;
    if (silence_ > 0 && quiet.count() > silence_) {
      *why = fmt::format("nothing was heard from the launcher for {} s", silence_);
      return false;
    }
    return true;
  }

 private:
  double silence_;
  Steady::time_point heard_ = Steady::now();
};

bool running(bp::child& child) {
  std::error_code ignored;
  return child.running(ignored);
}

/// As a shell finds it, but first beside this program.
std::string findProgram(const std::string& word) {
  if (word.find('/') != std::string::npos)
    return word;
  std::string beside = programFolder() + "/" + word;
  if (access(beside.c_str(), X_OK) == 0)
    return beside;
  std::string found = bp::search_path(word).string();
  if (found.empty())
    throw std::runtime_error(fmt::format(
        "cannot find the program {}, neither in {} nor on the PATH", word, programFolder()));
  return found;
}

void end(bp::child& child, bp::group& group, const HoldOptions& options) {
  ::kill(-group.native_handle(), signalNumber(options.stop_signal));
  const auto deadline = Steady::now() + std::chrono::duration<double>(options.grace);
  while (running(child) && Steady::now() < deadline)
    poll(nullptr, 0, kLookMs);
}

}  // namespace

int hold(const HoldOptions& options) {
  placeOnCpus(options);
  setPriority(options);
  const messaging::StopSignals signals;
  bp::environment environment = boost::this_process::environment();
  for (const std::string& entry : options.environment)
    environment[entry.substr(0, entry.find('='))] = entry.substr(entry.find('=') + 1);
  const pid_t self = getpid();
  const auto prepare = [self](auto& /*executor*/) { prepareChild(self, SIGKILL); };
  bp::group group;
  bp::child child;
  try {
    child = bp::child(
        bp::exe = findProgram(options.command.front()),
        bp::args = std::vector<std::string>(options.command.begin() + 1, options.command.end()),
        environment, group, bp::std_in < bp::null, bp::extend::on_exec_setup = prepare);
  } catch (const bp::process_error& e) {
    throw std::runtime_error(
        fmt::format("cannot start {}: {}", options.command.front(), e.code().message()));
  }
  Holder holder(options.silence);
  std::string why;
  while (running(child) && !signals.received() && holder.isThere(&why)) {
  }
  if (!why.empty())
    fmt::print(stderr, "fastball: {}: ending {}\n", why, options.command.front());
  if (running(child))
    end(child, group, options);
  // Whatever it has left behind in its group goes with it.
  ::kill(-group.native_handle(), SIGKILL);
  std::error_code ignored;
  child.wait(ignored);
  const int status = child.native_exit_code();
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace fastball::launch
