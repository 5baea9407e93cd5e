#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/process.hpp>
#include <boost/process/extend.hpp>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "launch/campaign/engine.h"
#include "launch/child_setup.h"
#include "launch/processes.h"

namespace fastball::launch {
namespace {

namespace bp = boost::process;
constexpr auto kWatchInterval = std::chrono::milliseconds(100);

struct Worker {
  bp::child child;
  bp::ipstream errors;
};

std::string lastLine(std::istream& stream) {
  std::string line, last;
  while (std::getline(stream, line)) {
    if (!line.empty())
      last = line;
  }
  return last;
}

}  // namespace

std::vector<std::string> workLocally(const std::string& folder,
                                     const std::string& todo,
                                     int jobs,
                                     const std::function<bool()>& watch) {
  std::vector<Worker> workers(static_cast<std::size_t>(jobs));
  const pid_t parent = getpid();
  for (int part = 0; part < jobs; ++part) {
    Worker& worker = workers[static_cast<std::size_t>(part)];
    worker.child = bp::child(
        programFolder() + "/fastball",
        bp::args({"campaign-part", folder, "--todo", todo, "--part", std::to_string(part),
                  "--parts", std::to_string(jobs)}),
        bp::std_in<bp::null, bp::std_out> bp::null, bp::std_err > worker.errors,
        bp::extend::on_exec_setup = [parent](auto& /*executor*/) {
          prepareChild(parent, SIGTERM);
        });
  }
  bool stopped = false;
  const auto running = [&] {
    bool any = false;
    for (Worker& worker : workers)
      any = worker.child.running() || any;
    return any;
  };
  while (running()) {
    if (!watch() && !stopped) {
      stopped = true;
      for (Worker& worker : workers) {
        if (worker.child.running())
          kill(worker.child.id(), SIGTERM);
      }
    }
    std::this_thread::sleep_for(kWatchInterval);
  }
  std::vector<std::string> faults;
  for (Worker& worker : workers) {
    worker.child.wait();
    const int status = worker.child.native_exit_code();
    if (status == 0 || stopped)
      continue;
    faults.push_back(WIFSIGNALED(status)
                         ? fmt::format("a part was ended by signal {} ({}); the same command goes "
                                       "on from what it had done",
                                       WTERMSIG(status), strsignal(WTERMSIG(status)))
                         : lastLine(worker.errors));
  }
  return faults;
}

}  // namespace fastball::launch
