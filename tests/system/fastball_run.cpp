#include "tests/system/fastball_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <boost/process/start_dir.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

namespace fastball::system_test {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr int kFirstPort = 20000;
constexpr int kPorts = 20000;

std::string newFolder() {
  static std::atomic<int> count = 0;
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("fastball-test-{}-{}", getpid(), count++);
  fs::create_directories(folder);
  return folder.string();
}

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Adds `flag value` to a command line that does not have the flag. @return the flag's value.
std::string addFlag(std::vector<std::string>& arguments,
                    const std::string& flag,
                    const std::string& value) {
  const auto found = std::find(arguments.begin(), arguments.end(), flag);
  if (found != arguments.end())
    return *std::next(found);
  arguments.insert(arguments.end(), {flag, value});
  return value;
}

/// Hands over the messages of `url` until `done`, or until `running` says no.
void listen(messaging::LcmEndpoint& endpoint,
            const bool& done,
            const std::function<bool()>& running) {
  while (!done && running()) {
    pollfd readable{endpoint.fileDescriptor(), POLLIN, 0};
    poll(&readable, 1, 50);
    endpoint.drain();
  }
}

}  // namespace

struct FastballRun::Impl {
  mutable bp::child child;
};

FastballRun::FastballRun(std::vector<std::string> arguments,
                         const std::vector<std::string>& wrapper)
    : folder_(newFolder()),
      url_(fmt::format("udpm://239.255.76.67:{}?ttl=0", kFirstPort + getpid() % kPorts)),
      impl_(std::make_unique<Impl>()) {
  const bool has_network =
      std::none_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
        return argument == "--no-network" || argument == "--system";
      });
  if (!arguments.empty() && arguments.front() == "run") {
    addFlag(arguments, "--json", folder_ + "/result.json");
    if (has_network)
      addFlag(arguments, "--log", logPath());
    if (has_network)
      url_ = addFlag(arguments, "--lcm-url", url_);
  }
  std::vector<std::string> words = wrapper;
  words.emplace_back(FASTBALL_BIN_DIR "/fastball");
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (!wrapper.empty())
    words.front() = bp::search_path(wrapper.front()).string();
  const std::string program = words.front();
  words.erase(words.begin());
  impl_->child = bp::child(bp::exe = program, bp::args = words, bp::start_dir = folder_,
                           bp::std_in<bp::null, (bp::std_out & bp::std_err)>(folder_ + "/output"));
}

FastballRun::~FastballRun() {
  if (running()) {
    signal(SIGINT);
    impl_->child.wait();
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

bool FastballRun::running() const {
  std::error_code ignored;
  return impl_->child.running(ignored);
}

Outcome FastballRun::wait() {
  while (running())
    pause();
  Outcome outcome;
  const int status = impl_->child.native_exit_code();
  outcome.exit_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  outcome.output = textOf(folder_ + "/output");
  const std::string json = textOf(folder_ + "/result.json");
  if (!json.empty())
    outcome.json = nlohmann::json::parse(json);
  return outcome;
}

void FastballRun::signal(int number) const {
  kill(impl_->child.id(), number);
}

int FastballRun::pid() const {
  return impl_->child.id();
}

std::map<std::string, int> FastballRun::children() const {
  std::map<std::string, int> found;
  std::ifstream list(fmt::format("/proc/{0}/task/{0}/children", pid()));
  for (int child = 0; list >> child;) {
    std::error_code error;
    const fs::path program = fs::read_symlink(fmt::format("/proc/{}/exe", child), error);
    if (!error)
      found[program.filename().string()] = child;
  }
  return found;
}

bool FastballRun::await(
    const std::function<void(messaging::LcmEndpoint&, bool& reached)>& subscribe) const {
  messaging::LcmEndpoint endpoint(url_);
  bool reached = false;
  subscribe(endpoint, reached);
  listen(endpoint, reached, [this] { return running(); });
  return reached;
}

void FastballRun::awaitSwing() const {
  const bool swings = await([](messaging::LcmEndpoint& endpoint, bool& reached) {
    endpoint.subscribe<controller_status_t>(
        messaging::kControllerStatus,
        [&reached](const auto& m) { reached = reached || m.phase == arm_command_t::SWING; });
  });
  ASSERT_TRUE(swings) << "ended before the arm swung: " << textOf(folder_ + "/output");
}

void FastballRun::awaitHeartbeat(const std::string& name) const {
  const bool heard = await([&name](messaging::LcmEndpoint& endpoint, bool& reached) {
    endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                    [&](const auto& m) { reached = reached || m.name == name; });
  });
  ASSERT_TRUE(heard) << "ended before " << name << " was heard: " << textOf(folder_ + "/output");
}

Outcome fastball(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& wrapper) {
  return FastballRun(arguments, wrapper).wait();
}

bool isRunning(int pid) {
  // A zombie has no program any more.
  std::error_code error;
  return !fs::read_symlink(fmt::format("/proc/{}/exe", pid), error).empty();
}

EditedConfig::EditedConfig(const std::string& file, const std::string& from, const std::string& to)
    : folder_(newFolder()) {
  fs::copy(FASTBALL_SOURCE_DIR "/config", folder_, fs::copy_options::recursive);
  std::string text = textOf(folder_ + "/" + file);
  const auto at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "config/" << file << " has no '" << from << "' to replace";
    return;
  }
  std::ofstream(folder_ + "/" + file) << text.replace(at, from.size(), to);
}

EditedConfig::~EditedConfig() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace fastball::system_test
