#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "launch/clock_check.h"
#include "launch/roster.h"
#include "launch/systems/held_process.h"
#include "launch/systems/state_folder.h"
#include "launch/systems/system_file.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {

/// Starts the processes of a system and looks after them until a SIGINT or SIGTERM: restarts those that shall be, notices a
/// HEARTBEAT that stays away, writes what it knows into the state folder twice a second.
class Supervisor {
 public:
  struct Listener {
    std::function<void()> ready;  ///< all processes are
    std::function<void(const std::string& line)>
        line;  ///< of output, "[name] " before it, and the supervisor's own
  };

  Supervisor(System system, StateFolder& folder, Listener listener);
  /// Returns after a SIGINT or SIGTERM, when all are stopped.
  /// @throw std::runtime_error, once all are stopped again, if one did not become ready, a
  ///   machine's clock is off by more than the system's clock_limit, or one of their names is on
  ///   the network already.
  void run();

 private:
  using Steady = std::chrono::steady_clock;
  enum class State { kStarting, kReady, kSilent, kWaiting, kEnded, kStopping };
  struct Member {
    SystemProcess process;
    std::unique_ptr<HeldProcess> held;
    State state = State::kStarting;
    Steady::time_point since;     ///< in this state
    Steady::time_point heard;     ///< its last HEARTBEAT
    int64_t heartbeat_utime = 0;  ///< of that
    int32_t old_pid = 0;          ///< of the one before a restart
    int restarts = 0;
    std::string note;  ///< how it ended, or empty
  };

  void refuseStrangers();
  void start(Member& member);
  void tick();
  void look(Member& member);
  void hear(Member& member);
  /// [s]; a planner that plans says nothing meanwhile.
  double silentAfter(const Member& member) const;
  void ended(Member& member);
  void enter(Member& member, State state);
  void stopNext();
  bool anyHeld() const;
  /// Measures the other machines' clocks. @return true when nothing is left to be done before the system is ready.
  bool checkClocks();
  void failBeforeReady(const Member& member, const std::string& what);
  void say(const std::string& line) const { listener_.line(line); }
  void writeState() const;

  System system_;
  StateFolder& folder_;
  Listener listener_;
  boost::asio::io_context context_;
  messaging::LcmEndpoint endpoint_;
  messaging::SystemClock clock_;
  Roster roster_;
  ClockCheck clocks_;
  std::vector<Member> members_;
  Steady::time_point next_beat_, next_write_;
  bool announced_ = false;
  bool stopping_ = false;
  std::string failure_;
};

}  // namespace fastball::launch
