#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

namespace fastball::messaging {

/// A program under test, with standard output and error in one text. Killed when its object dies.
class ChildProcess {
 public:
  explicit ChildProcess(std::vector<std::string> command) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      return;
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command)
      arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      execvp(arguments[0], arguments.data());
      _exit(127);
    }
    close(ends[1]);
    output_fd_ = ends[0];
  }
  ~ChildProcess() {
    if (running_)
      stop(SIGKILL);
    close(output_fd_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads until the output contains `text`. @return false if the program ends, or says nothing for `patience` [ms], without it.
  bool waitForOutput(const std::string& text, int patience = 30'000) {
    while (output_.find(text) == std::string::npos) {
      if (!readSome(patience))
        return false;
    }
    return true;
  }

  /// Waits for the program's end. @return its exit status, 128 + signal if a signal ended it, -1 if it does not end.
  int wait() {
    while (readSome()) {
    }
    int status = 0;
    // The output has ended, so the program has, or it hangs; then the test must not.
    for (int i = 0; i < 300; ++i) {
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        running_ = false;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      usleep(10'000);
    }
    return -1;
  }

  int stop(int signal) {
    kill(pid_, signal);
    return wait();
  }

  const std::string& output() const { return output_; }
  pid_t pid() const { return pid_; }

 private:
  bool readSome(int patience = 30'000) {
    pollfd ready{output_fd_, POLLIN, 0};
    if (poll(&ready, 1, patience) <= 0)
      return false;
    char buffer[4096];
    const ssize_t n = read(output_fd_, buffer, sizeof(buffer));
    if (n <= 0)
      return false;
    output_.append(buffer, static_cast<std::size_t>(n));
    return true;
  }

  pid_t pid_ = -1;
  int output_fd_ = -1;
  bool running_ = true;
  std::string output_;
};

}  // namespace fastball::messaging
