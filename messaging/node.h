#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messaging/clock.h"
#include "messaging/endpoint.h"

namespace fastball::messaging {

/// What a node says of itself in its HEARTBEAT.
struct NodeState {
  std::string state = "idle";  ///< one word
  std::string detail;          ///< a sentence, or empty
  int64_t plan_id = 0;         ///< plan or request held, 0: none
};

/// One process of the experiment without its process: subscribes in its constructor, acts in
/// step(). The runner (LCM loop, local network, or a test) drains the endpoint, calls step(), and
/// says the HEARTBEAT.
class Node {
 public:
  virtual ~Node() = default;
  /// Name in the HEARTBEAT, e.g. "controller".
  virtual std::string name() const = 0;
  /// Called after every drain, and at the latest at the time that wakeUs() names. Must not block.
  /// What it throws ends the process, which says it in its last HEARTBEAT and calls shutDown().
  virtual void step() {}
  /// Monotonic time [us] at which step() must be called even if no message comes; INT64_MAX: never.
  virtual int64_t wakeUs() const { return INT64_MAX; }
  virtual NodeState state() const = 0;
  /// These processes, heard before, have fallen silent, as the sentence says; called once each time. Only where there is a limit
  /// (PeerWatch).
  virtual void onSilence(const std::vector<std::string>& /*names*/,
                         const std::string& /*sentence*/) {}
  /// True when the process shall end by itself (for example after an unrecoverable error; state()
  /// says why).
  virtual bool finished() const { return false; }
  /// The last act before the process ends: a safe command, a flushed file.
  virtual void shutDown() {}
};

}  // namespace fastball::messaging
