#include "launch/silence_watch.h"

#include <gtest/gtest.h>

#include "tests/launch/scripted_peers.h"

namespace fastball::launch {
namespace {

TEST(SilenceWatch, NamesWhoHasStoppedTalkingUntilItTalksAgain) {
  messaging::ManualClock clock;
  messaging::LocalNetwork network(clock);
  messaging::Endpoint& peer = network.addEndpoint();
  const SilenceWatch watch(network.addEndpoint(), clock);
  const std::vector<std::string> names{"planner", "controller", "logger"};
  const auto hear = [&](const char* name) {
    heartbeat_t message{};
    message.name = name;
    message.host = "here";
    message.version = "test";
    message.state = "idle";
    ASSERT_TRUE(peer.publish(messaging::kHeartbeat, message));
    network.run([] { return false; });
  };
  EXPECT_EQ(watch.silentFor(0, names), "") << "nobody was ever heard";
  hear("planner");
  hear("controller");
  clock.advanceUs(3'000'000);
  hear("planner");
  clock.advanceUs(1'999'999);
  EXPECT_EQ(watch.silentFor(5, names), "");
  clock.advanceUs(1);
  EXPECT_EQ(watch.silentFor(5, names), "controller has said no HEARTBEAT for 5.0 s");
  EXPECT_EQ(watch.silentFor(5, {"planner"}), "");
  EXPECT_EQ(watch.silentFor(2, names),
            "planner has said no HEARTBEAT for 2.0 s, controller has said no HEARTBEAT for 5.0 s");
  hear("controller");
  EXPECT_EQ(watch.silentFor(5, names), "");
}

}  // namespace
}  // namespace fastball::launch
