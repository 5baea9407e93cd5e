#include "launch/systems/held_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/asio/read_until.hpp>
#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <cstring>
#include <istream>
#include <stdexcept>

#include "launch/child_setup.h"
#include "launch/processes.h"

namespace fastball::launch {
namespace {

namespace bp = boost::process;

constexpr std::size_t kLastLines = 10;
constexpr std::size_t kLongestLine = 65536;
constexpr double kSilence = 3;      // [s], of a link, then its processes end
constexpr int kSshFailed = 255;     // ssh's own exit status
constexpr int kSignalOffset = 128;  // of the exit status that `hold` gives for a signal

}  // namespace

std::string shellQuoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word)
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> holdCommand(const SystemProcess& process, const std::string& lcm_url) {
  const Host& host = process.host;
  const std::string folder = host.folder.empty() && host.isHere() ? programFolder() : host.folder;
  std::vector<std::string> words = {folder.empty() ? "fastball" : folder + "/fastball",
                                    "hold",
                                    "--stop-signal",
                                    process.stop_signal,
                                    "--grace",
                                    fmt::format("{}", process.grace),
                                    "--environment",
                                    "FASTBALL_LCM_URL=" + lcm_url};
  for (const std::string& entry : process.environment)
    words.insert(words.end(), {"--environment", entry});
  if (process.realtime_priority > 0)
    words.insert(words.end(), {"--realtime-priority", std::to_string(process.realtime_priority)});
  for (const int cpu : process.cpus)
    words.insert(words.end(), {"--cpu", std::to_string(cpu)});
  if (!host.isHere())
    words.insert(words.end(), {"--silence", fmt::format("{}", kSilence)});
  words.insert(words.end(), process.command.begin(), process.command.end());
  if (host.isHere() && host.work_folder.empty())
    return words;
  std::string line = host.work_folder.empty() ? "" : "cd " + shellQuoted(host.work_folder) + " && ";
  line += "exec";
  for (const std::string& word : words)
    line += " " + shellQuoted(word);
  if (host.isHere())
    return {"/bin/sh", "-c", line};
  std::vector<std::string> remote = host.ssh;
  remote.insert(remote.end(), {host.address, line});
  return remote;
}

HeldProcess::HeldProcess(boost::asio::io_context& context,
                         const std::vector<std::string>& command,
                         bool over_ssh,
                         const std::string& output_path,
                         OnLine on_line)
    : input_(context),
      output_(context),
      buffer_(kLongestLine),
      file_(output_path, std::ios::app),
      on_line_(std::move(on_line)),
      over_ssh_(over_ssh) {
  const pid_t self = getpid();
  // The holder sees its input end in any case; this is for a program in ssh's place that does not look.
  const auto prepare = [self](auto& /*executor*/) { prepareChild(self, SIGTERM); };
  const auto path = command.front().find('/') == std::string::npos
                        ? bp::search_path(command.front())
                        : boost::filesystem::path(command.front());
  if (path.empty())
    throw std::runtime_error(fmt::format("cannot find the program {}", command.front()));
  try {
    child_ = bp::child(bp::exe = path,
                       bp::args = std::vector<std::string>(command.begin() + 1, command.end()),
                       group_, bp::std_in<input_, (bp::std_out & bp::std_err)> output_,
                       bp::extend::on_exec_setup = prepare);
  } catch (const bp::process_error& e) {
    throw std::runtime_error(fmt::format("cannot start {}: {}", path.string(), e.code().message()));
  }
  fcntl(input_.native_sink(), F_SETFL, O_NONBLOCK);
  readLine();
}

HeldProcess::~HeldProcess() {
  *alive_ = false;
  if (running())
    kill();
}

void HeldProcess::readLine() {
  boost::asio::async_read_until(
      output_, buffer_, '\n',
      [this, alive = alive_](const boost::system::error_code& error, std::size_t) {
        if (!*alive)
          return;
        std::istream stream(&buffer_);
        std::string line;
        std::getline(stream, line);
        if (!error || !line.empty()) {
          file_ << line << std::endl;
          last_lines_.push_back(line);
          if (last_lines_.size() > kLastLines)
            last_lines_.pop_front();
          on_line_(line);
        }
        // A line without an end that fills the buffer is taken in pieces.
        if (!error || error == boost::asio::error::not_found)
          readLine();
      });
}

void HeldProcess::sayAlive() {
  // A holder that reads nothing, a stopped one, must not stop its launcher: what the full pipe does not take is left out.
  const char alive = '\n';
  [[maybe_unused]] const ssize_t written = ::write(input_.native_sink(), &alive, 1);
}

void HeldProcess::letGo() {
  boost::system::error_code ignored;
  input_.close(ignored);
}

void HeldProcess::kill() {
  std::error_code ignored;
  group_.terminate(ignored);
  child_.wait(ignored);
}

bool HeldProcess::running() {
  std::error_code ignored;
  return child_.running(ignored);
}

std::string HeldProcess::ending() const {
  const int status = child_.native_exit_code();
  if (WIFSIGNALED(status))
    return fmt::format("its holder was ended by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  const int code = WEXITSTATUS(status);
  if (over_ssh_ && code == kSshFailed)
    return "the connection ended (ssh's exit status 255)";
  if (code > kSignalOffset)
    return fmt::format("was ended by signal {} ({})", code - kSignalOffset,
                       strsignal(code - kSignalOffset));
  return fmt::format("ended by itself with exit status {}", code);
}

bool HeldProcess::endedWell() const {
  return child_.native_exit_code() == 0;
}

std::vector<std::string> HeldProcess::lastLines() const {
  return {last_lines_.begin(), last_lines_.end()};
}

}  // namespace fastball::launch
