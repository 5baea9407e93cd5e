#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/process/async_pipe.hpp>
#include <boost/process/child.hpp>
#include <boost/process/group.hpp>
#include <deque>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "launch/systems/system_file.h"

namespace fastball::launch {

/// The words with which a process is started: `fastball hold` here, or over ssh there. `--silence` only there: a link can go
/// dumb without ending.
std::vector<std::string> holdCommand(const SystemProcess& process, const std::string& lcm_url);

/// A word as a POSIX shell must be given it, for ssh hands its words to one.
std::string shellQuoted(const std::string& word);

/// One process of a system, held by this one: it ends when this object does, when this process does, and when the link does.
/// Its output goes to a file, and line by line to `on_line`.
class HeldProcess {
 public:
  using OnLine = std::function<void(const std::string& line)>;
  /// `on_line` is called by whoever runs `context`, which must outlive this object.
  /// @param over_ssh so that ssh's own failure is told from the program's
  /// @param output_path of a file to which the output is added
  /// @throw std::runtime_error if it cannot be started.
  HeldProcess(boost::asio::io_context& context,
              const std::vector<std::string>& command,
              bool over_ssh,
              const std::string& output_path,
              OnLine on_line);
  ~HeldProcess();
  HeldProcess(const HeldProcess&) = delete;
  HeldProcess& operator=(const HeldProcess&) = delete;

  /// Tells the other end that this one lives. Does not block.
  void sayAlive();
  /// Asks it to end.
  void letGo();
  /// Ends it from here at once.
  void kill();
  bool running();
  /// Once it is not running(): "ended by itself with exit status 1", "was ended by signal 9
  /// (Killed)", "the connection ended (ssh's exit status 255)", ...
  std::string ending() const;
  /// Once it is not running(): with exit status 0.
  bool endedWell() const;
  /// The last ten lines of its output.
  std::vector<std::string> lastLines() const;

 private:
  void readLine();

  boost::process::async_pipe input_, output_;
  boost::asio::streambuf buffer_;
  std::ofstream file_;
  OnLine on_line_;
  std::deque<std::string> last_lines_;
  bool over_ssh_;
  boost::process::group group_;  ///< so that a Ctrl-C at the terminal reaches only this program
  boost::process::child child_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< for handlers that come later
};

}  // namespace fastball::launch
