#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "launch/processes.h"

namespace fastball::view {

/// What a viewer may ask for.
struct ThrowOrder {
  int throws = 1;
  int64_t seed = 1;
  bool realtime = false;
};

/// Where runs that a viewer starts meet, and with what.
struct RunPlace {
  std::string lcm_url;
  std::string config;  ///< experiment file, empty: the default
  std::string key;     ///< file, empty: none
};

/// `fastball run` as a process of its own, at most one at a time.
class ThrowRun {
 public:
  static constexpr int kMostThrows = 20;

  explicit ThrowRun(RunPlace place) : place_(std::move(place)) {}
  /// Ends a run that goes on.
  ~ThrowRun();
  ThrowRun(const ThrowRun&) = delete;
  ThrowRun& operator=(const ThrowRun&) = delete;

  /// Starts a run; does nothing while one goes on.
  /// @throw std::invalid_argument if the order has no or more than kMostThrows throws, or a negative seed.
  /// @throw std::runtime_error if it cannot be started.
  void start(const ThrowOrder& order);
  /// Tells the run to end.
  void stop();
  /// Looks whether the newest run goes on; the two below are as of the last look.
  bool goesOn();
  /// True if the newest run has ended and has not made its throws.
  bool failed() const { return failed_; }
  /// The last lines that it has written.
  std::string words() const { return words_; }

 private:
  RunPlace place_;
  std::unique_ptr<launch::Processes> processes_;
  std::string words_;
  bool failed_ = false;
};

}  // namespace fastball::view
