#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "messaging/endpoint.h"
#include "messaging/heartbeat.h"
#include "messaging/node.h"

namespace fastball::messaging {

/// All nodes of an experiment in one process, wired through memory: no network, no threads, no time
/// but that of `clock`. Messages arrive in the order in which they were published. A publisher does
/// not hear itself unless it subscribes.
class LocalNetwork {
 public:
  explicit LocalNetwork(const Clock& clock);
  ~LocalNetwork();
  /// A new endpoint; it lives as long as the network.
  Endpoint& addEndpoint();
  /// Runs `node` on `endpoint`, which must be of this network. The node must outlive run().
  void addNode(Node& node, Endpoint& endpoint);
  /// Round after round: drain every endpoint, step every node, in the order of addNode (endpoints
  /// without a node come last); until `done()`, or until nothing moves any more (no message, no
  /// heartbeat, no node whose wake time has come), which is returned as false. A node that is
  /// finished() is shut down and hears no more.
  bool run(const std::function<bool()>& done);
  /// Earliest monotonic time [us] at which a node wants to be stepped, INT64_MAX: never. When run()
  /// returns false, only the Clock can bring something new.
  int64_t nextWakeUs() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastball::messaging
