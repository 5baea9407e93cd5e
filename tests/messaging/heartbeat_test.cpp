#include "messaging/heartbeat.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "messaging/local_network.h"
#include "messaging/version.h"
#include "tests/messaging/examples.h"
#include "tests/messaging/scripted_node.h"

namespace fastball::messaging {
namespace {

class HeartbeatTest : public ::testing::Test {
 protected:
  HeartbeatTest() {
    listener.subscribe<heartbeat_t>(kHeartbeat, [this](const auto& m) { heard.push_back(m); });
  }
  /// How many heartbeats an update says.
  std::size_t update(double loop_us = 0) {
    heard.clear();
    heartbeat.update(loop_us);
    listener.drain();
    return heard.size();
  }

  ManualClock clock;
  LocalNetwork network{clock};
  Endpoint& listener = network.addEndpoint();
  Endpoint& endpoint = network.addEndpoint();
  ScriptedNode node{"planner"};
  Heartbeat heartbeat{endpoint, clock, node};
  std::vector<heartbeat_t> heard;
};

TEST_F(HeartbeatTest, SaysWhoItIs) {
  node.node_state = {"planning", "throw 3", 3};
  clock.advanceUs(5);
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].name, "planner");
  EXPECT_EQ(heard[0].pid, getpid());
  EXPECT_EQ(heard[0].version, version());
  EXPECT_FALSE(heard[0].host.empty());
  EXPECT_EQ(heard[0].state, "planning");
  EXPECT_EQ(heard[0].detail, "throw 3");
  EXPECT_EQ(heard[0].plan_id, 3);
  EXPECT_EQ(heard[0].utime, 5);
}

TEST_F(HeartbeatTest, IsSaidOnceASecond) {
  EXPECT_EQ(update(), 1U);
  EXPECT_EQ(update(), 0U);
  clock.advanceUs(999'999);
  EXPECT_EQ(update(), 0U);
  EXPECT_EQ(heartbeat.wakeUs(), 1'000'000);
  clock.advanceUs(1);
  EXPECT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].seq, 1);
  EXPECT_EQ(heartbeat.wakeUs(), 2'000'000);
}

TEST_F(HeartbeatTest, IsSaidAsOftenAsAskedFor) {
  Heartbeat fast(endpoint, clock, node, 0.1);
  fast.update(0);
  EXPECT_EQ(fast.wakeUs(), 100'000);
}

TEST_F(HeartbeatTest, ANoteIsSaidAtOnceBehindTheNodesOwnWords) {
  node.node_state.detail = "ready";
  update();
  heartbeat.setNote("the cable is cut");
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].detail, "ready; the cable is cut");
  heartbeat.setNote("");
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].detail, "ready");
}

TEST_F(HeartbeatTest, IsSaidAtOnceWhenStatePlanOrDetailChange) {
  update();
  node.node_state.state = "armed";
  EXPECT_EQ(update(), 1U);
  node.node_state.plan_id = 2;
  EXPECT_EQ(update(), 1U);
  node.node_state.detail = "ready";
  EXPECT_EQ(update(), 1U);
  EXPECT_EQ(update(), 0U);
}

TEST_F(HeartbeatTest, SumsCountsOfAllChannels) {
  endpoint.subscribe<arm_state_t>(kArmState, [](const auto&) {});
  endpoint.subscribe<estop_t>(kEstop, [](const auto&) { throw std::runtime_error("no"); });
  for (const int64_t seq : {0, 4}) {
    auto state = examples::example<arm_state_t>();
    state.seq = seq;
    listener.publish(kArmState, state);
  }
  listener.publish(kEstop, examples::example<estop_t>());
  endpoint.drain();
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].received, 2);
  EXPECT_EQ(heard[0].lost, 3);
  EXPECT_EQ(heard[0].invalid, 1);
}

TEST_F(HeartbeatTest, GivesMeanAndLongestLoopOfTheLastSecond) {
  update(1000);
  update(2);
  clock.advanceUs(1'000'000);
  ASSERT_EQ(update(4), 1U);
  EXPECT_DOUBLE_EQ(heard[0].loop_mean_us, 3);
  EXPECT_DOUBLE_EQ(heard[0].loop_max_us, 4);
}

TEST_F(HeartbeatTest, LongDetailIsShortenedNotLost) {
  node.node_state.detail.assign(5000, 'x');
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].detail.size(), kSentenceBytes);
}

TEST_F(HeartbeatTest, LastWordsAreKnownAsSuch) {
  heartbeat.sayLast();
  listener.drain();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].state, "ended");
}

TEST_F(HeartbeatTest, NamesTheKeyBehindTheVersion) {
  Heartbeat keyed(endpoint, clock, node, Heartbeat::kPeriod, "0123abcd");
  keyed.update(0);
  heartbeat.update(0);
  listener.drain();
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].version, std::string(version()) + ", key 0123abcd");
  EXPECT_EQ(keyIdOf(heard[0]), "0123abcd");
  EXPECT_EQ(keyIdOf(heard[1]), "");
}

TEST_F(HeartbeatTest, ARemarkIsSaidAtOnceBehindTheDetail) {
  node.node_state.detail = "throw 3";
  update();
  heartbeat.remark("refused 1 SCENE");
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].detail, "throw 3; refused 1 SCENE");
  EXPECT_EQ(update(), 0U);
  node.node_state.detail.clear();
  ASSERT_EQ(update(), 1U);
  EXPECT_EQ(heard[0].detail, "refused 1 SCENE");
}

TEST_F(HeartbeatTest, LastWordsNameTheFailure) {
  heartbeat.sayLast("the disk is full");
  listener.drain();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].state, "failed");
  EXPECT_EQ(heard[0].detail, "the disk is full");
}

}  // namespace
}  // namespace fastball::messaging
