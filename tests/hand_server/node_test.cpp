// The hand server's node among scripted peers, in memory: the messages it answers with and what it says of itself.
#include "hand_server/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messaging/local_network.h"
#include "tests/hand_server/messages.h"
#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

using ::testing::HasSubstr;

class HandServerNode : public testing::Test {
 protected:
  explicit HandServerNode(bool realtime = false) {
    messaging::ProcessOptions options;
    options.config = kExperimentPath;
    options.realtime = realtime;
    messaging::Endpoint& door = network_.addEndpoint();
    node_ = makeNode(door, clock_, options);
    network_.addNode(*node_, door);
    peer_.subscribe<hand_command_t>(messaging::kHandCommand,
                                    [this](const hand_command_t& m) { commands_.push_back(m); });
    peer_.subscribe<release_t>(messaging::kRelease,
                               [this](const release_t& m) { releases_.push_back(m); });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                 [this](const heartbeat_t& m) { heartbeat_ = m; });
  }

  template <class T>
  void say(const messaging::Channel<T>& channel, const T& message) {
    ASSERT_TRUE(peer_.publish(channel, message));
    settle();
  }
  void settle() {
    network_.run([] { return false; });
  }
  void arm() {
    say(messaging::kSwingPlan, planMessage(throwPlan()));
    EXPECT_EQ(heartbeat_.state, "planned");
    EXPECT_EQ(heartbeat_.plan_id, 1);
    say(messaging::kThrowStart, startMessage(1, 1, 300'000));
    EXPECT_EQ(heartbeat_.state, "armed");
  }
  void tick(int64_t tick, double force) {
    say(messaging::kHandState, stateMessage(1, tick, hand_.q, hand_.qd, force));
    hand_.tick(answerOf(commands_.back()));
  }

  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& peer_ = network_.addEndpoint();
  std::unique_ptr<messaging::Node> node_;
  ScriptedHand hand_;
  std::vector<hand_command_t> commands_;
  std::vector<release_t> releases_;
  heartbeat_t heartbeat_{};
};

TEST_F(HandServerNode, AThrowFromPlanToDeparture) {
  settle();
  EXPECT_EQ(heartbeat_.state, "idle");
  arm();
  for (int i = 0; i < 900; ++i) {
    tick(i, i <= 808 ? 2.0 : 0.0);
    ASSERT_EQ(commands_.size(), i + 1u);
    EXPECT_EQ(commands_.back().tick, i);
    EXPECT_EQ(commands_.back().utime, 1000 * i);
    EXPECT_EQ(commands_.back().plan_id, 1);
    EXPECT_EQ(heartbeat_.state, i < 300 ? "armed" : i < 800 ? "running" : "released");
  }
  ASSERT_EQ(releases_.size(), 2u);
  EXPECT_EQ(releases_[0].event, int{release_t::COMMANDED});
  EXPECT_EQ(releases_[0].reason, int{release_t::PLAN_TIME});
  EXPECT_EQ(releases_[0].utime, 800'000);
  EXPECT_EQ(releases_[0].scene_id, 1);
  EXPECT_EQ(releases_[0].f_normal[1], 2.0);
  EXPECT_EQ(releases_[1].event, int{release_t::DEPARTED});
  EXPECT_NEAR(static_cast<double>(releases_[1].utime), 808e3 - 1e3, 1e3)
      << "about the last state with a touch, less the sensors' delay";
  EXPECT_EQ(releases_[0].predicted_utime, 810'000) << "the plan's word, before any throw";
  EXPECT_EQ(releases_[1].predicted_utime, 810'000);
  EXPECT_EQ(releases_[0].grip_force, releases_[1].grip_force);
  EXPECT_EQ(releases_[1].planned_utime, 810'000);
}

TEST_F(HandServerNode, ARepeatedStateGetsItsAnswerAgainAndNoSecondRelease) {
  arm();
  for (int i = 0; i < 800; ++i)
    tick(i, 2.0);
  for (int i = 0; i < 3; ++i)
    say(messaging::kHandState, stateMessage(1, 800, hand_.q, hand_.qd, 2.0));
  ASSERT_EQ(commands_.size(), 803u);
  EXPECT_EQ(commands_[802].tau[model::kProximalThumb], commands_[800].tau[model::kProximalThumb]);
  EXPECT_EQ(releases_.size(), 1u);
}

TEST_F(HandServerNode, EstopKeepsTheGripAndSaysSo) {
  arm();
  for (int i = 0; i < 500; ++i)
    tick(i, 2.0);
  estop_t estop{};
  estop.reason = "test";
  say(messaging::kEstop, estop);
  EXPECT_EQ(heartbeat_.state, "holding");
  EXPECT_EQ(heartbeat_.detail, "kept the ball: ESTOP: test");
  for (int i = 500; i < 900; ++i)
    tick(i, 2.0);
  EXPECT_EQ(commands_.back().phase, int{hand_command_t::HOLD});
  EXPECT_TRUE(releases_.empty());
}

TEST_F(HandServerNode, KeepsTheBallWhenTheExperimentFallsSilent) {
  arm();
  for (int i = 0; i < 500; ++i)
    tick(i, 2.0);
  node_->onSilence({"planner"}, "one is silent");
  settle();
  EXPECT_EQ(heartbeat_.state, "running");
  node_->onSilence({"experiment"}, "one is silent");
  settle();
  EXPECT_EQ(heartbeat_.state, "holding");
  EXPECT_EQ(heartbeat_.detail, "kept the ball: one is silent");
}

TEST_F(HandServerNode, AnArmThatLeavesThePlanKeepsTheBall) {
  arm();
  for (int i = 0; i < 500; ++i)
    tick(i, 2.0);
  arm_state_t state{};
  state.scene_id = 1;
  state.utime = 500'000;
  say(messaging::kArmState, state);
  EXPECT_EQ(heartbeat_.state, "holding");
  EXPECT_THAT(heartbeat_.detail, HasSubstr("from plan 1"));
}

TEST_F(HandServerNode, ARefusedPlanIsSaidWithItsReason) {
  HandPlan plan = throwPlan(4);
  plan.grip_force = 0;
  say(messaging::kSwingPlan, planMessage(plan));
  EXPECT_EQ(heartbeat_.state, "refused");
  EXPECT_EQ(heartbeat_.plan_id, 4);
  EXPECT_THAT(heartbeat_.detail, HasSubstr("plan 4: a grip of 0 N"));
}

class HandServerNodeInRealTime : public HandServerNode {
 protected:
  HandServerNodeInRealTime() : HandServerNode(true) {}
};

TEST_F(HandServerNodeInRealTime, OnlyTheNewestStateIsAnswered) {
  for (int i = 0; i < 5; ++i)
    peer_.publish(messaging::kHandState, stateMessage(1, i, hand_.q, hand_.qd, 0));
  settle();
  ASSERT_EQ(commands_.size(), 1u);
  EXPECT_EQ(commands_[0].tick, 4);
}

/// The parameter: who goes silent.
class SilentRobot : public HandServerNodeInRealTime, public testing::WithParamInterface<bool> {
 protected:
  void both(int64_t i, bool arm, bool hand) {
    arm_state_t state{};
    state.scene_id = 1;
    state.tick = i;
    state.utime = 1000 * i;
    const Eigen::Vector4d q = throwPlan().arm.at(1e-6 * static_cast<double>(state.utime) - 0.3).q;
    std::copy_n(q.data(), 4, state.q);
    if (arm)
      say(messaging::kArmState, state);
    if (hand)
      tick(i, 2.0);
    clock_.advanceUs(1000);
  }
};

TEST_P(SilentRobot, KeepsTheBallAndSaysSoAndThatItIsBack) {
  const bool arm_is_silent = GetParam();
  arm();
  for (int i = 0; i < 500; ++i)
    both(i, true, true);
  ASSERT_EQ(heartbeat_.state, "running");
  for (int i = 500; i < 525; ++i)
    both(i, !arm_is_silent, arm_is_silent);
  const std::string sentence = std::string("kept the ball: no ") +
                               (arm_is_silent ? "ARM_STATE" : "HAND_STATE") +
                               " for more than 20 ms";
  EXPECT_EQ(heartbeat_.state, "holding");
  EXPECT_EQ(heartbeat_.detail, sentence);
  for (int i = 525; i < 900; ++i)
    both(i, true, true);
  EXPECT_EQ(heartbeat_.detail, sentence + "; it comes again");
  EXPECT_EQ(commands_.back().phase, int{hand_command_t::HOLD});
  EXPECT_TRUE(releases_.empty());
}

INSTANTIATE_TEST_SUITE_P(OfEither, SilentRobot, testing::Bool(), [](const auto& test) {
  return test.param ? "arm" : "hand";
});

}  // namespace
}  // namespace fastball::hand_server
