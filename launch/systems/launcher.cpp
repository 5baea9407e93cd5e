#include "launch/systems/launcher.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "launch/systems/supervisor.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

constexpr double kPatience = 5;  // [s], beyond the grace of all processes

void printLine(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void supervise(const System& system, StateFolder& folder, const std::function<void()>& ready) {
  if (!folder.lock())
    throw std::runtime_error(fmt::format("{} is up already; see 'fastball ps'", system.path));
  // A process that has just ended leaves a pipe without a reader.
  std::signal(SIGPIPE, SIG_IGN);
  Supervisor(system, folder, {ready, printLine}).run();
}

/// What the launcher says before it closes the pipe. A signal that comes meanwhile is handed on to it.
std::string awaitAnswer(int answer, pid_t launcher, const messaging::StopSignals& signals) {
  std::string text;
  std::array<char, 1024> bytes{};
  bool handed_on = false;
  while (true) {
    std::array<pollfd, 2> waits = {pollfd{answer, POLLIN, 0},
                                   pollfd{handed_on ? -1 : signals.fileDescriptor(), POLLIN, 0}};
    poll(waits.data(), waits.size(), -1);
    if (signals.received() && !handed_on) {
      kill(launcher, SIGINT);
      handed_on = true;
    }
    if (waits[0].revents == 0)
      continue;
    const ssize_t got = read(answer, bytes.data(), bytes.size());
    if (got <= 0)
      break;
    text.append(bytes.data(), static_cast<std::size_t>(got));
  }
  return handed_on && text.empty() ? "interrupted" : text;
}

/// The launcher's process: all that is left of the terminal is `answer`, a pipe that gets a sentence if it fails, and is closed
/// without one when all is ready.
[[noreturn]] void launcherMain(const System& system, StateFolder& folder, int answer) {
  setsid();
  const int log = open((folder.path() + "/launcher.log").c_str(),
                       O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  int status = 0;
  try {
    supervise(system, folder, [&answer] { close(std::exchange(answer, -1)); });
  } catch (const std::exception& e) {
    const std::string sentence = e.what();
    // After it was ready nobody listens here any more.
    [[maybe_unused]] const ssize_t written = write(answer, sentence.data(), sentence.size());
    printLine(sentence);
    status = 1;
  }
  std::fflush(stdout);
  _exit(status);
}

}  // namespace

void superviseHere(const System& system, StateFolder& folder) {
  supervise(system, folder, [&] { printLine(fmt::format("{} is ready", system.path)); });
}

void superviseBehind(const System& system, StateFolder& folder) {
  std::array<int, 2> answer{};
  if (pipe2(answer.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no file descriptor left");
  // Until it is ready an interrupted `up` leaves nothing behind.
  const messaging::StopSignals signals;
  std::fflush(stdout);
  const pid_t launcher = fork();
  if (launcher < 0)
    throw std::runtime_error("cannot start the launcher");
  if (launcher == 0) {
    close(answer[0]);
    launcherMain(system, folder, answer[1]);
  }
  close(answer[1]);
  const std::string sentence = awaitAnswer(answer[0], launcher, signals);
  close(answer[0]);
  if (!sentence.empty()) {
    waitpid(launcher, nullptr, 0);
    throw std::runtime_error(sentence);
  }
}

bool endLauncher(const StateFolder& folder, const System& system) {
  const auto state = folder.read();
  if (!folder.isLocked() || !state)
    return false;
  double patience = kPatience;
  for (const SystemProcess& process : system.processes)
    patience += process.grace;
  const pid_t launcher = state->value("launcher", 0);
  if (launcher > 1)
    kill(launcher, SIGINT);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (folder.isLocked()) {
    if (std::chrono::steady_clock::now() > end)
      throw std::runtime_error(
          fmt::format("the launcher (process {}) did not end within {} s", launcher, patience));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace fastball::launch
