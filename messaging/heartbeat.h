#pragma once

#include <string>

#include "messaging/clock.h"
#include "messaging/endpoint.h"
#include "messaging/node.h"

namespace fastball::messaging {

/// Says HEARTBEAT for a node: once a second and whenever its state(), detail or plan_id change.
class Heartbeat {
 public:
  Heartbeat(Endpoint& endpoint, const Clock& clock, const Node& node);
  /// Call after every step(). `loop_us`: how long drain and step took, for the loop figures.
  void update(double loop_us);
  /// The last words of a process. `failure`: the sentence it fails with, sent as state "failed";
  /// empty: the node's own state.
  void sayLast(const std::string& failure = "");
  /// Monotonic time [us] of the next heartbeat due.
  int64_t wakeUs() const { return next_us_; }

 private:
  void say();
  Endpoint& endpoint_;
  const Clock& clock_;
  const Node& node_;
  Publisher<heartbeat_t> publisher_;
  NodeState said_;
  heartbeat_t message_{};
  int64_t next_us_ = INT64_MIN;
  double loop_sum_us_ = 0;
  double loop_max_us_ = 0;
  int64_t loops_ = 0;
};

}  // namespace fastball::messaging
