#pragma once

#include <string>
#include <vector>

namespace fastball::launch {

/// How a program is held.
struct HoldOptions {
  std::vector<std::string> command;  ///< a program without '/' is beside this one, else on the PATH
  std::vector<std::string> environment;  ///< "KEY=VALUE", beside that of this process
  std::string stop_signal = "INT";       ///< INT, TERM, HUP or QUIT
  double grace = 2;                      ///< [s], from the stop signal to KILL
  double silence = 0;  ///< [s] without a byte on standard input that end the program; 0: none do
  int realtime_priority = 0;  ///< of SCHED_FIFO, 0: none
  std::vector<int> cpus;      ///< empty: all
};

/// Runs a program for as long as somebody holds this process's standard input open, on this machine or at the other end of an
/// ssh connection: when it ends (the launcher or the link died), when nothing has come on it for `silence`, or on SIGINT and
/// SIGTERM, the program's process group gets the stop signal, and KILL after the grace. The program gets no input.
/// @return its exit status, 128 + signal if a signal ended it.
/// @throw std::runtime_error if it cannot be started as wished.
int hold(const HoldOptions& options);

}  // namespace fastball::launch
