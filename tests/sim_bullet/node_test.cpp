#include "sim_bullet/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/sim_bullet/simulator_in_process.h"

namespace fastball::sim_bullet {
namespace {

using testing::HasSubstr;

TEST_F(Simulator, IsIdleBeforeTheFirstScene) {
  settle();
  EXPECT_EQ(node_.state().state, "idle");
  EXPECT_TRUE(peers_.arm_states.empty());
  EXPECT_EQ(node_.wakeUs(), INT64_MAX);
}

TEST_F(Simulator, WaitsForBothCommandsOfATick) {
  peers_.answers_arm = peers_.answers_hand = false;
  peers_.sendScene(sceneMessage(1, 1));
  settle();
  ASSERT_EQ(peers_.arm_states.size(), 1u);
  ASSERT_EQ(peers_.hand_states.size(), 1u);
  EXPECT_EQ(peers_.tick(), 0);
  EXPECT_EQ(peers_.arm_states[0].utime, 10'000'000);
  peers_.sendArm(peers_.armCommand(peers_.arm_states[0]));
  settle();
  EXPECT_EQ(peers_.tick(), 0);
  peers_.sendHand(ScriptedPeers::handCommandFor(peers_.hand_states[0]));
  settle();
  EXPECT_EQ(peers_.tick(), 1);
  EXPECT_EQ(peers_.arm_states.back().utime, 10'001'000);
  EXPECT_EQ(peers_.hand_states.back().tick, 1);
}

TEST_F(Simulator, SaysTheStateAgainWhenAnAnswerIsLate) {
  peers_.answers_hand = false;
  peers_.sendScene(sceneMessage(1, 1));
  settle();
  clock_.advanceUs(19'999);
  settle();
  EXPECT_EQ(peers_.arm_states.size(), 1u);
  clock_.advanceUs(1);
  settle();
  ASSERT_EQ(peers_.arm_states.size(), 2u);
  ASSERT_EQ(peers_.hand_states.size(), 2u);
  EXPECT_EQ(peers_.arm_states[1].tick, 0);
  EXPECT_EQ(peers_.arm_states[1].utime, peers_.arm_states[0].utime);
  EXPECT_GT(peers_.arm_states[1].seq, peers_.arm_states[0].seq);
  peers_.sendHand(ScriptedPeers::handCommandFor(peers_.hand_states[1]));
  settle();
  EXPECT_EQ(peers_.tick(), 1);
}

TEST_F(Simulator, SaysThatTheHandIsAskedForMoreSpeedThanItHas) {
  peers_.answers_hand = false;
  peers_.sendScene(sceneMessage(1, 1));
  settle();
  hand_command_t command = ScriptedPeers::handCommandFor(peers_.hand_states[0]);
  command.qd[model::kWristRoll] = 40;  // the limit is the fingers'
  command.qd[model::kDistalThumb] = -40;
  peers_.sendHand(command);
  settle();
  EXPECT_EQ(peers_.tick(), 1);
  EXPECT_EQ(node_.state().detail,
            "saturated: HAND_COMMAND asks for 40 rad/s of hand joint 6 at tick 0, its drive does "
            "31.42 rad/s");
}

TEST_F(Simulator, LeavesCommandsForOtherTicksAndScenesAlone) {
  peers_.answers_arm = false;
  peers_.sendScene(sceneMessage(3, 1));
  settle();
  for (const int64_t tick : {1, 5}) {
    arm_command_t command = peers_.armCommand(peers_.arm_states[0]);
    command.tick = tick;
    peers_.sendArm(command);
  }
  for (const int64_t scene : {2, 4}) {
    arm_command_t command = peers_.armCommand(peers_.arm_states[0]);
    command.scene_id = scene;
    peers_.sendArm(command);
  }
  settle();
  EXPECT_EQ(peers_.tick(), 0);
  EXPECT_EQ(node_.strayCommands(), 4);
}

TEST_F(Simulator, NamesACommandBeforeTheFirstScene) {
  arm_command_t command{};
  command.scene_id = 3;
  peers_.sendArm(command);
  settle();
  EXPECT_EQ(node_.state().detail,
            "refused 1 ARM_COMMAND of a second sender; the first answers scene 3 before any has "
            "begun");
  peers_.sendScene(sceneMessage(1, 0.05));
  settle();
  EXPECT_EQ(node_.state().state, "finished");
  EXPECT_EQ(node_.refusedCommands(), 0);
}

TEST_F(Simulator, ASecondControllerIsRefusedAndNamedAndMovesNothing) {
  peers_.sendScene(sceneMessage(1, 0.05));
  settle();
  EXPECT_EQ(node_.refusedCommands(), 0);
  const arm_state_t alone = peers_.arm_states.back();

  ScriptedPeers second(network_.addEndpoint());
  second.answers_hand = false;
  second.push = 5;
  peers_.sendScene(sceneMessage(2, 0.05));
  settle();
  EXPECT_EQ(peers_.tick(), alone.tick);
  EXPECT_EQ(std::memcmp(peers_.arm_states.back().q, alone.q, sizeof(alone.q)), 0);
  EXPECT_GE(node_.refusedCommands(), 32);
  EXPECT_THAT(node_.state().detail,
              HasSubstr("refused 32 ARM_COMMANDs of a second sender; the first differs from the "
                        "one before about tick 0"));
}

TEST_F(Simulator, AControllerOfAnEarlierRunDoesNotTakeTheArmOver) {
  ScriptedPeers earlier(network_.addEndpoint());
  earlier.answers_arm = earlier.answers_hand = false;
  for (int i = 0; i < 100; ++i)
    earlier.sendArm({});
  peers_.sendScene(sceneMessage(1, 0.05));
  ASSERT_TRUE(runTo(10));
  peers_.answers_arm = false;
  settle();
  const int64_t tick = peers_.tick();
  earlier.sendArm(earlier.armCommand(peers_.arm_states.back()));
  settle();
  EXPECT_EQ(peers_.tick(), tick);
  EXPECT_EQ(node_.refusedCommands(), 1);
  EXPECT_THAT(node_.state().detail, HasSubstr("has seq 100 after "));
  peers_.answers_arm = true;
  clock_.advanceUs(20'000);
  settle();
  EXPECT_EQ(node_.state().state, "finished");
}

TEST_F(Simulator, RunsASceneToItsEnd) {
  peers_.sendScene(sceneMessage(1, 0.2));
  peers_.sendScene(sceneMessage(1, 0.2));  // a repetition
  settle();
  EXPECT_EQ(peers_.tick(), 199);
  EXPECT_EQ(peers_.arm_states.size(), 200u);
  EXPECT_EQ(peers_.count(sim_truth_t::SAMPLE), 20);
  EXPECT_EQ(peers_.count(sim_truth_t::FINISHED), 1);
  EXPECT_EQ(peers_.truths.back().event, +sim_truth_t::FINISHED);
  EXPECT_EQ(peers_.truths.back().utime, 10'200'000);
  EXPECT_EQ(node_.state().state, "finished");
  EXPECT_EQ(node_.state().plan_id, 1);
  for (const hand_state_t& state : peers_.hand_states)
    EXPECT_TRUE(state.tick < 100 || state.f_normal[model::kThumb] > 1) << state.tick;

  peers_.sendScene(sceneMessage(1, 0.2));  // too late to mean anything
  settle();
  EXPECT_EQ(peers_.arm_states.size(), 200u);
  peers_.sendScene(sceneMessage(2, 0.05));
  settle();
  EXPECT_EQ(peers_.arm_states.size(), 250u);
  EXPECT_EQ(node_.state().plan_id, 2);
}

TEST_F(Simulator, LostAndRepeatedMessagesDoNotChangeTheThrow) {
  peers_.push = 1;
  peers_.sendScene(sceneMessage(1, 0.15));
  settle();
  const arm_state_t clean = peers_.arm_states.back();

  peers_.sendScene(sceneMessage(2, 0.15));
  for (int64_t tick = 0; tick < 150; ++tick) {
    peers_.answers_arm = tick % 3 != 0;
    peers_.answers_hand = tick % 7 != 0;
    settle();
    peers_.answers_arm = peers_.answers_hand = true;
    peers_.sendArm(peers_.armCommand(peers_.arm_states.back()));
    peers_.sendArm(peers_.armCommand(peers_.arm_states.back()));
    clock_.advanceUs(20'000);
    network_.run([&] { return peers_.tick() > tick; });
  }
  settle();
  const arm_state_t battered = peers_.arm_states.back();
  EXPECT_EQ(node_.refusedCommands(), 0);
  EXPECT_EQ(battered.tick, clean.tick);
  EXPECT_EQ(std::memcmp(battered.q, clean.q, sizeof(clean.q)), 0);
  EXPECT_EQ(std::memcmp(battered.qd, clean.qd, sizeof(clean.qd)), 0);
}

TEST_F(Simulator, ASceneThatCannotBeFailsWithItsReasonAndTheNextOneRuns) {
  scene_t scene = sceneMessage(1, 0.1);
  scene.q_arm[3] = -2;
  peers_.sendScene(scene);
  settle();
  EXPECT_EQ(node_.state().state, "failed");
  EXPECT_THAT(node_.state().detail, HasSubstr("joint 4 at -2 rad"));
  EXPECT_TRUE(peers_.arm_states.empty());
  peers_.sendScene(sceneMessage(2, 0.05));
  settle();
  EXPECT_EQ(node_.state().state, "finished");
}

TEST_F(Simulator, RefusesScenesThatMakeNoSense) {
  std::vector<scene_t> scenes(4, sceneMessage(1, 0.1));
  scenes[0].duration = scenes[0].camera_end = 1e300;
  scenes[1].utime = INT64_MAX;
  scenes[2].n_WTarget[0] = 0;
  scenes[2].n_WTarget[2] = 1;
  scenes[3].target_radius = 1e12;
  const std::vector<std::string> reasons{"1e+300 s", "9223372036854775807 us", "lies flat",
                                         "radius"};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].scene_id = static_cast<int64_t>(i) + 1;
    peers_.sendScene(scenes[i]);
    settle();
    EXPECT_EQ(node_.state().state, "failed");
    EXPECT_THAT(node_.state().detail, HasSubstr(reasons[i]));
  }
}

TEST_F(Simulator, SaysTheEventsOfAFinishedSceneAgainForTwoSeconds) {
  peers_.sendScene(sceneMessage(1, 0.2));
  settle();
  const sim_truth_t finished = peers_.truths.back();
  EXPECT_EQ(finished.event_index, 1 + peers_.count(sim_truth_t::RELEASED) +
                                      peers_.count(sim_truth_t::LANDED) +
                                      peers_.count(sim_truth_t::TOUCHED));
  while (node_.wakeUs() != INT64_MAX) {
    clock_.advanceUs(node_.wakeUs() - clock_.monotonicUs());
    settle();
  }
  EXPECT_EQ(clock_.monotonicUs(), 2'000'000);
  EXPECT_EQ(peers_.count(sim_truth_t::FINISHED), 11);
  EXPECT_EQ(peers_.truths.back().event_index, finished.event_index);
  EXPECT_EQ(peers_.truths.back().utime, finished.utime);
}

TEST_F(Simulator, TheLightCurtainSaysItsLandingAgainToASceneThatIsSaidAgain) {
  std::vector<int64_t> landings;
  peer_endpoint_.subscribe<landing_t>(
      messaging::kLanding, [&](const landing_t& m) { landings.push_back(m.request_id); });
  peers_.sendScene(sceneMessage(1, 0.01));
  settle();
  EXPECT_EQ(landings, std::vector<int64_t>{1});
  peers_.sendScene(sceneMessage(1, 0.01));
  settle();
  EXPECT_EQ(landings, (std::vector<int64_t>{1, 1}));
  EXPECT_EQ(node_.state().state, "finished");
}

TEST_F(Simulator, ANewSceneEndsTheOldOne) {
  peers_.answers_arm = false;
  peers_.sendScene(sceneMessage(1, 1));
  settle();
  peers_.sendScene(sceneMessage(2, 1));
  settle();
  EXPECT_EQ(peers_.count(sim_truth_t::FINISHED), 1);
  EXPECT_EQ(peers_.arm_states.back().scene_id, 2);
}

}  // namespace
}  // namespace fastball::sim_bullet
