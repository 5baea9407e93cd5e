#pragma once

#include <gtest/gtest.h>

#include "messaging/local_network.h"
#include "sim_bullet/node.h"
#include "tests/sim_bullet/scripted_robot_peers.h"

namespace fastball::sim_bullet {

inline SimulatorSetup setup(bool realtime) {
  return {experiment(), simulation(), {}, std::nullopt, realtime};
}

/// A simulator and scripted peers in one process; the wall clock stands unless a test moves it.
class Simulator : public testing::Test {
 protected:
  explicit Simulator(bool realtime = false) : node_(endpoint_, clock_, setup(realtime)) {
    network_.addNode(node_, endpoint_);
  }
  /// Runs until nothing moves any more.
  void settle() {
    network_.run([] { return false; });
  }
  /// Runs until the simulator has said this tick's states.
  bool runTo(int64_t tick) {
    return network_.run([&] { return peers_.tick() >= tick; });
  }

  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& endpoint_ = network_.addEndpoint();
  messaging::Endpoint& peer_endpoint_ = network_.addEndpoint();
  SimNode node_;
  ScriptedPeers peers_{peer_endpoint_};
};

}  // namespace fastball::sim_bullet
