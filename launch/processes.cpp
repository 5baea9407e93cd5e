#include "launch/processes.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/group.hpp>
#include <boost/process/io.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "launch/child_setup.h"

namespace fastball::launch {
namespace {

namespace bp = boost::process;
using SteadyClock = std::chrono::steady_clock;

constexpr int kLastLines = 5;
constexpr std::size_t kLastBytes = 4000;
constexpr auto kPollInterval = std::chrono::milliseconds(5);

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

struct Processes::Process {
  std::string name;
  std::unique_ptr<std::FILE, CloseFile> output;  ///< stdout and stderr, a file without a name
  bp::group group;
  bp::child child;

  bool running() {
    std::error_code ignored;
    return child.running(ignored);
  }
  void kill() {
    std::error_code ignored;
    group.terminate(ignored);
    child.wait(ignored);
  }
};

Processes::Processes() = default;

Processes::~Processes() {
  for (auto& process : processes_) {
    if (process->running())
      process->kill();
  }
}

void Processes::start(const ProcessCommand& command) {
  auto process = std::make_unique<Process>();
  process->name = command.name;
  process->output.reset(fdopen(memfd_create(command.name.c_str(), MFD_CLOEXEC), "w+"));
  if (!process->output)
    throw std::runtime_error("cannot make a file for a process's output");
  const pid_t self = getpid();
  const auto prepare = [self](auto& /*executor*/) { prepareChild(self, SIGTERM); };
  try {
    process->child =
        bp::child(bp::exe = command.program, bp::args = command.arguments, process->group,
                  bp::std_in<bp::null, (bp::std_out & bp::std_err)> process->output.get(),
                  bp::extend::on_exec_setup = prepare);
  } catch (const bp::process_error& e) {
    throw std::runtime_error(
        fmt::format("cannot start {}: {}: {}", command.name, command.program, e.code().message()));
  }
  processes_.push_back(std::move(process));
}

int Processes::pid(const std::string& name) const {
  for (const auto& process : processes_) {
    if (process->name == name)
      return process->child.id();
  }
  return 0;
}

std::vector<std::string> Processes::names() const {
  std::vector<std::string> all;
  for (const auto& process : processes_)
    all.push_back(process->name);
  return all;
}

std::optional<std::string> Processes::ended() {
  for (auto& process : processes_) {
    if (process->running())
      continue;
    const int status = process->child.native_exit_code();
    if (WIFSIGNALED(status)) {
      return fmt::format("{} was ended by signal {} ({})\n{}", process->name, WTERMSIG(status),
                         strsignal(WTERMSIG(status)), lastOutput(process->name));
    }
    return fmt::format("{} ended by itself with exit status {}\n{}", process->name,
                       WEXITSTATUS(status), lastOutput(process->name));
  }
  return std::nullopt;
}

int Processes::exitStatus(const std::string& name) {
  for (auto& process : processes_) {
    if (process->name != name || process->running())
      continue;
    const int status = process->child.native_exit_code();
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return -1;
}

std::string Processes::lastOutput(const std::string& name) const {
  std::string text;
  for (const auto& process : processes_) {
    if (process->name != name)
      continue;
    const int file = fileno(process->output.get());
    const off_t end = lseek(file, 0, SEEK_END);
    const off_t begin = std::max<off_t>(0, end - static_cast<off_t>(kLastBytes));
    std::array<char, kLastBytes> bytes{};
    const ssize_t got = pread(file, bytes.data(), bytes.size(), begin);
    if (got > 0)
      text.assign(bytes.data(), static_cast<std::size_t>(got));
  }
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::size_t from = text.size();
  for (int line = 0; line < kLastLines && from != std::string::npos && from != 0; ++line) {
    from = text.rfind('\n', from - 1);
  }
  if (from != std::string::npos && from != 0)
    text.erase(0, from + 1);
  std::string prefixed = text.empty() ? "" : fmt::format("[{}] ", name);
  for (const char c : text) {
    prefixed += c;
    if (c == '\n')
      prefixed += fmt::format("[{}] ", name);
  }
  return prefixed;
}

std::vector<std::string> Processes::stopSome(double grace, const std::vector<Process*>& some) {
  for (Process* process : some) {
    if (process->running())
      ::kill(process->child.id(), SIGINT);
  }
  const auto deadline = SteadyClock::now() + std::chrono::duration<double>(grace);
  std::vector<std::string> killed;
  for (Process* process : some) {
    while (process->running() && SteadyClock::now() < deadline) {
      std::this_thread::sleep_for(kPollInterval);
    }
    if (!process->running())
      continue;
    process->kill();
    killed.push_back(process->name);
  }
  return killed;
}

std::vector<std::string> Processes::stop(double grace, const std::string& last) {
  std::vector<Process*> first_ones;
  std::vector<Process*> last_ones;
  for (auto& process : processes_) {
    (process->name == last ? last_ones : first_ones).push_back(process.get());
  }
  std::vector<std::string> killed = stopSome(grace, first_ones);
  for (const std::string& name : stopSome(grace, last_ones))
    killed.push_back(name);
  processes_.clear();
  return killed;
}

std::string programFolder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace fastball::launch
