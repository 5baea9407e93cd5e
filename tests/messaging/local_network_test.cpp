#include "messaging/local_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "tests/messaging/examples.h"
#include "tests/messaging/scripted_node.h"

namespace fastball::messaging {
namespace {

using examples::example;
using ::testing::ElementsAre;

class LocalNetworkTest : public ::testing::Test {
 protected:
  bool runUntilQuiet() {
    return network.run([] { return false; });
  }
  ManualClock clock;
  LocalNetwork network{clock};
};

TEST_F(LocalNetworkTest, MessagesArriveInTheOrderOfPublishing) {
  Endpoint& a = network.addEndpoint();
  Endpoint& b = network.addEndpoint();
  std::vector<std::string> heard;
  b.subscribe<arm_state_t>(
      kArmState, [&](const auto& m) { heard.push_back("state " + std::to_string(m.tick)); });
  b.subscribe<hand_state_t>(
      kHandState, [&](const auto& m) { heard.push_back("hand " + std::to_string(m.tick)); });
  for (int tick = 0; tick < 2; ++tick) {
    auto arm = example<arm_state_t>();
    auto hand = example<hand_state_t>();
    arm.tick = hand.tick = tick;
    EXPECT_TRUE(a.publish(kArmState, arm));
    EXPECT_TRUE(a.publish(kHandState, hand));
  }
  EXPECT_EQ(b.drain(), 4);
  EXPECT_THAT(heard, ElementsAre("state 0", "hand 0", "state 1", "hand 1"));
  EXPECT_EQ(b.drain(), 0);
  EXPECT_EQ(a.drain(), 0);
}

TEST_F(LocalNetworkTest, PublisherHearsItselfOnlyIfItSubscribes) {
  Endpoint& a = network.addEndpoint();
  a.publish(kEstop, example<estop_t>());
  EXPECT_EQ(a.drain(), 0);
  a.subscribe<estop_t>(kEstop, [](const auto&) {});
  a.publish(kEstop, example<estop_t>());
  EXPECT_EQ(a.drain(), 1);
}

TEST_F(LocalNetworkTest, BrokenMessageIsNotSent) {
  Endpoint& a = network.addEndpoint();
  Endpoint& b = network.addEndpoint();
  b.subscribe<arm_command_t>(kArmCommand, [](const auto&) { FAIL(); });
  auto command = example<arm_command_t>();
  command.tau[1] = NAN;
  EXPECT_FALSE(a.publish(kArmCommand, command));
  EXPECT_EQ(a.unsent(), 1);
  EXPECT_EQ(b.drain(), 0);
}

TEST_F(LocalNetworkTest, HandlerThatThrowsCountsItsMessageAsInvalid) {
  Endpoint& a = network.addEndpoint();
  int calls = 0;
  a.subscribe<estop_t>(kEstop, [&](const auto&) {
    if (++calls == 1)
      throw std::runtime_error("no");
  });
  a.publish(kEstop, example<estop_t>());
  a.publish(kEstop, example<estop_t>());
  EXPECT_EQ(a.drain(), 2);
  EXPECT_EQ(a.counts().at("ESTOP").invalid, 1);
  EXPECT_EQ(a.counts().at("ESTOP").accepted, 1);
}

TEST_F(LocalNetworkTest, GapsAndRepetitionsAreCounted) {
  Endpoint& a = network.addEndpoint();
  std::vector<int64_t> heard;
  a.subscribe<arm_state_t>(kArmState, [&](const auto& m) { heard.push_back(m.seq); });
  for (const int64_t seq : {5, 6, 9, 9, 10, 0, 1}) {
    auto state = example<arm_state_t>();
    state.seq = seq;
    a.publish(kArmState, state);
  }
  a.drain();
  EXPECT_THAT(heard, ElementsAre(5, 6, 9, 9, 10, 0, 1));
  const ReceiveCounts& counts = a.counts().at("ARM_STATE");
  EXPECT_EQ(counts.accepted, 7);
  EXPECT_EQ(counts.lost, 2);      // 7 and 8
  EXPECT_EQ(counts.repeated, 2);  // the second 9, and 0 from a sender that began again
}

TEST_F(LocalNetworkTest, ANumberFromNowhereDoesNotSpoilTheCount) {
  Endpoint& a = network.addEndpoint();
  a.subscribe<arm_state_t>(kArmState, [](const auto&) {});
  for (const int64_t seq : {int64_t{0}, INT64_MAX, int64_t{0}, INT64_MAX, int64_t{0}, int64_t{2}}) {
    auto state = example<arm_state_t>();
    state.seq = seq;
    a.publish(kArmState, state);
  }
  a.drain();
  EXPECT_EQ(a.counts().at("ARM_STATE").lost, 1);
}

TEST_F(LocalNetworkTest, GapsAreNotCountedWhereManySend) {
  Endpoint& a = network.addEndpoint();
  a.subscribe<heartbeat_t>(kHeartbeat, [](const auto&) {});
  for (const int64_t seq : {0, 100, 1, 101}) {
    auto beat = example<heartbeat_t>();
    beat.seq = seq;
    a.publish(kHeartbeat, beat);
  }
  a.drain();
  EXPECT_EQ(a.counts().at("HEARTBEAT").lost, 0);
  EXPECT_EQ(a.counts().at("HEARTBEAT").repeated, 0);
}

TEST_F(LocalNetworkTest, TwoHandlersOfAChannelCountAMessageOnce) {
  Endpoint& a = network.addEndpoint();
  Latest<estop_t> latest(a, kEstop);
  int calls = 0;
  a.subscribe<estop_t>(kEstop, [&](const auto&) { ++calls; });
  a.publish(kEstop, example<estop_t>());
  a.drain();
  EXPECT_EQ(calls, 1);
  EXPECT_NE(latest.get(), nullptr);
  EXPECT_EQ(a.counts().at("ESTOP").accepted, 1);
}

TEST_F(LocalNetworkTest, LatestKeepsTheNewestAndTakesItOnce) {
  Endpoint& a = network.addEndpoint();
  Latest<arm_state_t> latest(a, kArmState);
  EXPECT_EQ(latest.get(), nullptr);
  EXPECT_EQ(latest.takeNew(), nullptr);
  Publisher<arm_state_t> publisher(a, kArmState);
  for (int tick = 0; tick < 3; ++tick) {
    auto state = example<arm_state_t>();
    state.tick = tick;
    publisher.publish(state);
  }
  a.drain();
  ASSERT_NE(latest.takeNew(), nullptr);
  EXPECT_EQ(latest.takeNew(), nullptr);
  EXPECT_EQ(latest.get()->tick, 2);
  EXPECT_EQ(latest.get()->seq, 2);
}

/// Two nodes that pass a state and a command to and fro, as the robot and its controller do.
TEST_F(LocalNetworkTest, RunsUntilDone) {
  Endpoint& robot_end = network.addEndpoint();
  Endpoint& controller_end = network.addEndpoint();
  ScriptedNode robot("robot");
  ScriptedNode controller("controller");
  int64_t tick = -1;
  const auto say_state = [&] {
    auto state = example<arm_state_t>();
    state.tick = ++tick;
    robot_end.publish(kArmState, state);
  };
  robot_end.subscribe<arm_command_t>(kArmCommand, [&](const auto&) { say_state(); });
  controller_end.subscribe<arm_state_t>(kArmState, [&](const auto& state) {
    auto command = example<arm_command_t>();
    command.tick = state.tick;
    controller_end.publish(kArmCommand, command);
  });
  network.addNode(robot, robot_end);
  network.addNode(controller, controller_end);
  say_state();
  EXPECT_TRUE(network.run([&] { return tick >= 1000; }));
  EXPECT_EQ(tick, 1000);
}

TEST_F(LocalNetworkTest, StopsWhenNothingMoves) {
  ScriptedNode node;
  network.addNode(node, network.addEndpoint());
  EXPECT_FALSE(runUntilQuiet());
  EXPECT_LT(node.steps, 10);
}

TEST_F(LocalNetworkTest, NodeWhoseWakeTimeHasComeIsSteppedAgain) {
  ScriptedNode node;
  node.wake_us = 0;
  node.on_step = [&] {
    if (node.steps == 50)
      node.wake_us = 5000;
  };
  network.addNode(node, network.addEndpoint());
  EXPECT_FALSE(runUntilQuiet());
  EXPECT_EQ(node.steps, 50);
  EXPECT_EQ(network.nextWakeUs(), 5000);
}

TEST_F(LocalNetworkTest, PublicationInAStepIsMovement) {
  Endpoint& speaker_end = network.addEndpoint();
  Endpoint& listener_end = network.addEndpoint();
  ScriptedNode listener;
  ScriptedNode speaker;
  int heard = 0;
  listener_end.subscribe<estop_t>(kEstop, [&](const auto&) { ++heard; });
  speaker.on_step = [&] {
    if (speaker.steps <= 3)
      speaker_end.publish(kEstop, example<estop_t>());
  };
  network.addNode(listener, listener_end);
  network.addNode(speaker, speaker_end);
  EXPECT_FALSE(runUntilQuiet());
  EXPECT_EQ(heard, 3);
}

TEST_F(LocalNetworkTest, HeartbeatsOfAllNodesAreHeard) {
  Endpoint& listener = network.addEndpoint();
  std::vector<std::string> heard;
  listener.subscribe<heartbeat_t>(kHeartbeat,
                                  [&](const auto& m) { heard.push_back(m.name + " " + m.state); });
  ScriptedNode a("a");
  ScriptedNode b("b");
  a.on_step = [&] { a.node_state.state = a.steps < 2 ? "idle" : "armed"; };
  network.addNode(a, network.addEndpoint());
  network.addNode(b, network.addEndpoint());
  EXPECT_FALSE(runUntilQuiet());
  EXPECT_THAT(heard, ElementsAre("a idle", "b idle", "a armed"));
}

TEST_F(LocalNetworkTest, FinishedNodeIsShutDownOnceAndHearsNoMore) {
  Endpoint& end = network.addEndpoint();
  Endpoint& other = network.addEndpoint();
  ScriptedNode node;
  int heard = 0;
  end.subscribe<estop_t>(kEstop, [&](const auto&) { ++heard; });
  node.is_finished = true;
  network.addNode(node, end);
  EXPECT_FALSE(runUntilQuiet());
  other.publish(kEstop, example<estop_t>());
  EXPECT_FALSE(runUntilQuiet());
  EXPECT_EQ(node.shut_downs, 1);
  EXPECT_EQ(node.steps, 1);
  EXPECT_EQ(heard, 0);
}

}  // namespace
}  // namespace fastball::messaging
