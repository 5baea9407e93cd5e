#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "messaging/endpoint.h"
#include "messaging/heartbeat.h"
#include "messaging/node.h"

namespace fastball::messaging {

/// All nodes of an experiment in one process, wired through memory: no network, no threads, no wall time. Messages arrive in
/// the order in which they were published. A publisher does not hear itself unless it subscribes.
class LocalNetwork {
 public:
  explicit LocalNetwork(const Clock& clock);
  ~LocalNetwork();
  /// A new endpoint; it lives as long as the network.
  Endpoint& addEndpoint();
  /// Runs `node` on `endpoint`. Both must outlive run().
  void addNode(Node& node, Endpoint& endpoint);
  /// Round after round: drain every endpoint, step every node, in the order of addNode; until `done()`, or until nothing
  /// moves any more (no message, no heartbeat), which is returned as false.
  bool run(const std::function<bool()>& done);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastball::messaging
