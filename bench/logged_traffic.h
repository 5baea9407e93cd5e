#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "messaging/lcm_endpoint.h"

namespace fastball::bench {

/// Messages of one channel at an even rate, in bursts of so many.
struct Stream {
  std::string channel;
  std::size_t bytes;
  double rate;  ///< [1/s] of bursts
  int burst = 1;
};

/// Says all streams for `seconds` on time, or as soon after as the machine lets it.
/// @return how many messages of each channel the network took, and in `took` [s] how long it took.
std::map<std::string, int64_t> sayStreams(messaging::LcmEndpoint& endpoint,
                                          const std::vector<Stream>& streams,
                                          double seconds,
                                          double& took);

/// Threads that do nothing but keep processors busy, while it lives.
class BusyLoops {
 public:
  explicit BusyLoops(int count);
  ~BusyLoops();
  BusyLoops(const BusyLoops&) = delete;
  BusyLoops& operator=(const BusyLoops&) = delete;

 private:
  std::atomic<bool> end_{false};
  std::vector<std::thread> threads_;
};

/// A program that logs.
struct LoggerCommand {
  std::string program;
  std::vector<std::string> arguments;
  std::string log;
};

/// The logger of this project, beside the running program, and LCM's own; its `program` is empty where that is not installed.
LoggerCommand ourLogger(const std::string& url);
LoggerCommand stockLogger(const std::string& url);

/// Runs the loggers beside each other while `say` says messages, and reads their logs, which are removed.
/// @return how many of the messages that `say` returns each lacks.
/// @throw std::runtime_error if a logger does not start.
using Say = std::function<std::map<std::string, int64_t>(messaging::LcmEndpoint&)>;
std::vector<int64_t> lostBy(const std::vector<LoggerCommand>& loggers,
                            const std::string& url,
                            const Say& say);

}  // namespace fastball::bench
