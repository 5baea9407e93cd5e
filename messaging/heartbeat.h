#pragma once

#include <string>

#include "messaging/clock.h"
#include "messaging/endpoint.h"
#include "messaging/node.h"

namespace fastball::messaging {

/// This machine, as HEARTBEAT and CLOCK name it; "unknown" where it has no name.
std::string hostName();

/// Says HEARTBEAT for a node: once a period and whenever its state(), detail or plan_id change.
class Heartbeat {
 public:
  static constexpr double kPeriod = 1;  ///< [s]
  /// @param period [s]
  /// @param key_id of the key that the process's commands carry (CommandKey::id()), empty: none. It stands behind the version.
  Heartbeat(Endpoint& endpoint,
            const Clock& clock,
            const Node& node,
            double period = kPeriod,
            const std::string& key_id = "");
  /// What is said behind the node's own detail from now on: a sentence, or empty.
  void setNote(const std::string& note) { note_ = note; }
  /// Another such sentence, behind that.
  void remark(const std::string& sentence) { remark_ = sentence; }
  /// Call after every step(). `loop_us`: how long drain and step took [us], for the loop figures.
  void update(double loop_us);
  /// The last words of a process, state "ended", or "failed" if the node is or `failure`, a sentence, is not empty.
  void sayLast(const std::string& failure = "");
  /// Monotonic time [us] of the next heartbeat due.
  int64_t wakeUs() const { return next_us_; }

 private:
  NodeState words() const;
  void say();
  Endpoint& endpoint_;
  const Clock& clock_;
  const Node& node_;
  Publisher<heartbeat_t> publisher_;
  const int64_t period_us_;
  std::string note_, remark_;
  NodeState said_;
  heartbeat_t message_{};
  int64_t next_us_ = INT64_MIN;
  double loop_sum_us_ = 0;
  double loop_max_us_ = 0;
  int64_t loops_ = 0;
};

/// The key that a HEARTBEAT names, or empty.
std::string keyIdOf(const heartbeat_t& heartbeat);

}  // namespace fastball::messaging
