#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "launch/throw_script.h"
#include "messaging/process.h"

namespace fastball::launch {

/// The command line of `fastball run`.
struct RunOptions {
  int throws = 3;
  int64_t seed = 1;
  std::string strategy;     ///< empty: the one of the experiment file
  std::string config;       ///< empty: the default experiment
  std::string uncertainty;  ///< empty: no errors are injected
  std::string key;          ///< file, empty: commands carry no tag
  std::string learned;      ///< file of strategy adaptive; empty: it begins anew
  std::string log;          ///< empty: runs/<time>-seed<seed>.lcmlog
  std::string json;         ///< empty: none
  bool realtime = false;
  bool no_network = false;
  bool no_images = false;
  std::string
      system;  ///< file of the system whose processes make the throws; empty: processes of its own
  std::string lcm_url;
  std::string command_line;  ///< as typed, for the log's record
};

/// A run whose inputs have been read and found good.
struct RunSetup {
  RunSettings settings;
  messaging::ProcessOptions options;                 ///< for every process
  std::shared_ptr<const messaging::CommandKey> key;  ///< that of options.key
  std::string arm;                                   ///< profile of the arm
  std::string log;                                   ///< path of the log, empty: none
  std::string command_line;                          ///< for the record beside the log
  bool on_system = false;                            ///< the processes are there already
  double clock_limit = 0;  ///< [s], between this machine's clock and others; 0: not measured
};

/// Reads the experiment file with every process's section and checks all that can be checked before
/// anything is started. Makes the folder runs/ if a log is to be written and none is named.
/// @throw std::invalid_argument with a sentence that names file, line and key, or the flag.
RunSetup prepareRun(const RunOptions& options);

/// @throw std::invalid_argument if no file can be written at `path`; `flag` is named then. A file that is there stays as it is.
void requireWritable(const std::string& flag, const std::string& path);

}  // namespace fastball::launch
