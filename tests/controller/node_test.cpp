// The controller's node among scripted peers, in memory: the messages it answers with and what it says of itself.
#include "controller/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messaging/local_network.h"
#include "tests/controller/closed_loop.h"
#include "tests/controller/messages.h"

namespace fastball::controller {
namespace {

using ::testing::HasSubstr;

class ControllerNode : public testing::Test {
 protected:
  explicit ControllerNode(bool realtime = false) {
    messaging::ProcessOptions options;
    options.config = kExperimentPath;
    options.realtime = realtime;
    messaging::Endpoint& door = network_.addEndpoint();
    node_ = makeNode(door, clock_, options);
    network_.addNode(*node_, door);
    peer_.subscribe<arm_command_t>(messaging::kArmCommand,
                                   [this](const arm_command_t& m) { commands_.push_back(m); });
    peer_.subscribe<controller_status_t>(
        messaging::kControllerStatus,
        [this](const controller_status_t& m) { statuses_.push_back(m); });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                 [this](const heartbeat_t& m) { heartbeats_.push_back(m); });
  }

  void settle() {
    network_.run([] { return false; });
  }
  template <class T>
  void say(const messaging::Channel<T>& channel, const T& message) {
    ASSERT_TRUE(peer_.publish(channel, message));
    settle();
  }
  std::string heard() { return heartbeats_.empty() ? "" : heartbeats_.back().state; }

  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& peer_ = network_.addEndpoint();
  std::unique_ptr<messaging::Node> node_;
  std::vector<arm_command_t> commands_;
  std::vector<controller_status_t> statuses_;
  std::vector<heartbeat_t> heartbeats_;
};

TEST_F(ControllerNode, AThrowFromPlanToHold) {
  settle();
  EXPECT_EQ(heard(), "idle");
  say(messaging::kSwingPlan, planMessage(swingPlan()));
  EXPECT_EQ(heard(), "planned");
  EXPECT_EQ(heartbeats_.back().plan_id, 1);
  say(messaging::kThrowStart, startMessage(1, 1, 600'000));
  EXPECT_EQ(heard(), "armed");

  SimulatedArm robot{testArm(), kBack};
  for (int tick = 0; tick <= 1650; ++tick) {
    say(messaging::kArmState, stateMessage(1, tick, robot.q, robot.qd));
    ASSERT_EQ(commands_.size(), tick + 1u);
    const arm_command_t& command = commands_.back();
    EXPECT_EQ(command.tick, tick);
    EXPECT_EQ(command.utime, 1000 * tick);
    EXPECT_EQ(command.scene_id, 1);
    EXPECT_EQ(command.plan_id, 1);
    robot.tick(Eigen::Map<const Eigen::Vector4d>(command.tau));
    EXPECT_EQ(heard(), tick < 600 ? "armed" : tick < 1600 ? "running" : "holding");
  }
  EXPECT_EQ(commands_.back().phase, int{arm_command_t::HOLD});
  EXPECT_LT((robot.q - kFront).norm(), 1e-4);
  // 50 Hz from 0 to 1.65 s, and once more for those of the five changes of phase that fall between.
  EXPECT_GE(statuses_.size(), 83u);
  EXPECT_LE(statuses_.size(), 88u);
  EXPECT_LT(statuses_.back().q_error_max[0], 1e-3);
}

TEST_F(ControllerNode, TakesTheNextOrderThoughTheSceneEndedATickBeforeItsPlan) {
  say(messaging::kSwingPlan, planMessage(swingPlan()));
  say(messaging::kThrowStart, startMessage(1, 1, 600'000));
  SimulatedArm robot{testArm(), kBack};
  for (int tick = 0; tick < 1600; ++tick) {
    say(messaging::kArmState, stateMessage(1, tick, robot.q, robot.qd));
    robot.tick(Eigen::Map<const Eigen::Vector4d>(commands_.back().tau));
  }
  EXPECT_EQ(heard(), "running");
  say(messaging::kSwingPlan, planMessage(swingPlan(2)));
  say(messaging::kThrowStart, startMessage(2, 2, 10'600'000));
  EXPECT_EQ(heard(), "armed");
  arm_state_t state = stateMessage(2, 0, kBack, Eigen::Vector4d::Zero());
  state.utime = 10'000'000;
  say(messaging::kArmState, state);
  EXPECT_EQ(heard(), "armed");
  EXPECT_EQ(commands_.back().plan_id, 2);
}

TEST_F(ControllerNode, ARepeatedStateGetsItsAnswerAgain) {
  for (int i = 0; i < 3; ++i)
    say(messaging::kArmState, stateMessage(1, 0, kBack, Eigen::Vector4d::Zero()));
  ASSERT_EQ(commands_.size(), 3u);
  EXPECT_EQ(commands_[2].tau[1], commands_[0].tau[1]);
  EXPECT_NE(commands_[0].tau[1], 0) << "the arm is held against its weight before there is a plan";
  EXPECT_EQ(statuses_.size(), 1u);
}

TEST_F(ControllerNode, InLockstepEveryStateIsAnsweredHoweverManyWait) {
  for (int tick = 0; tick < 5; ++tick)
    peer_.publish(messaging::kArmState, stateMessage(1, tick, kBack, Eigen::Vector4d::Zero()));
  settle();
  EXPECT_EQ(commands_.size(), 5u);
}

TEST_F(ControllerNode, ARefusedPlanIsSaidWithItsReason) {
  Plan plan = swingPlan(4);
  plan.t_swing_end = 100;
  say(messaging::kSwingPlan, planMessage(plan));
  EXPECT_EQ(heard(), "refused");
  EXPECT_EQ(heartbeats_.back().plan_id, 4);
  EXPECT_THAT(heartbeats_.back().detail, HasSubstr("plan 4: its times are out of order"));
}

TEST_F(ControllerNode, WhatThePlannerRefusedIsNoPlan) {
  swing_plan_t message = planMessage(swingPlan(4));
  message.status = swing_plan_t::REFUSED;
  say(messaging::kSwingPlan, message);
  EXPECT_EQ(heard(), "idle");
}

TEST_F(ControllerNode, EstopBrakes) {
  say(messaging::kArmState, stateMessage(1, 0, kBack, Eigen::Vector4d::Zero()));
  estop_t estop{};
  estop.reason = "test";
  say(messaging::kEstop, estop);
  EXPECT_EQ(heard(), "braked");
  say(messaging::kArmState, stateMessage(1, 1, kBack, Eigen::Vector4d::Zero()));
  EXPECT_EQ(commands_.back().phase, int{arm_command_t::BRAKE});
  EXPECT_EQ(statuses_.back().message, "braked: ESTOP: test");
}

TEST_F(ControllerNode, BrakesWhenTheExperimentFallsSilentAndForNobodyElse) {
  say(messaging::kArmState, stateMessage(1, 0, kBack, Eigen::Vector4d::Zero()));
  node_->onSilence({"planner", "vision_tracker"}, "two are silent");
  settle();
  EXPECT_EQ(heard(), "idle") << "who else matters is for the experiment to say";
  node_->onSilence({"experiment", "planner"}, "two are silent");
  settle();
  EXPECT_EQ(heard(), "braked");
  say(messaging::kArmState, stateMessage(1, 1, kBack, Eigen::Vector4d::Zero()));
  EXPECT_EQ(commands_.back().phase, int{arm_command_t::BRAKE});
  EXPECT_EQ(statuses_.back().message, "braked: two are silent");
}

class ControllerNodeInRealTime : public ControllerNode {
 protected:
  ControllerNodeInRealTime() : ControllerNode(true) {}
};

TEST_F(ControllerNodeInRealTime, OnlyTheNewestStateIsAnswered) {
  for (int tick = 0; tick < 5; ++tick)
    peer_.publish(messaging::kArmState, stateMessage(1, tick, kBack, Eigen::Vector4d::Zero()));
  settle();
  ASSERT_EQ(commands_.size(), 1u);
  EXPECT_EQ(commands_[0].tick, 4);
}

TEST_F(ControllerNodeInRealTime, SilenceOfTheArmInASwingBrakes) {
  say(messaging::kSwingPlan, planMessage(swingPlan()));
  say(messaging::kThrowStart, startMessage(1, 1, 0));
  EXPECT_EQ(node_->wakeUs(), INT64_MAX) << "before the swing nothing is awaited";
  for (int tick = 0; tick < 5; ++tick)
    say(messaging::kArmState, stateMessage(1, tick, kBack, Eigen::Vector4d::Zero()));
  EXPECT_EQ(heard(), "running");
  clock_.advanceUs(25'000);
  settle();
  EXPECT_EQ(heard(), "braked");
  EXPECT_EQ(statuses_.back().message, "braked: no ARM_STATE for more than 20 ms");
  EXPECT_EQ(heartbeats_.back().detail, "braked: no ARM_STATE for more than 20 ms");
  say(messaging::kArmState, stateMessage(1, 30, kBack, Eigen::Vector4d::Zero()));
  EXPECT_EQ(commands_.back().phase, int{arm_command_t::BRAKE});
  EXPECT_EQ(heartbeats_.back().detail, "braked: no ARM_STATE for more than 20 ms; it comes again");
  say(messaging::kArmState, stateMessage(2, 0, kBack, Eigen::Vector4d::Zero()));
  EXPECT_EQ(heartbeats_.back().detail, "");
}

}  // namespace
}  // namespace fastball::controller
