// The simulator as a real process, against scripted peers over LCM.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/config/temporary_folder.h"
#include "tests/messaging/child_process.h"
#include "tests/sim_bullet/scripted_robot_peers.h"

namespace fastball::sim_bullet {
namespace {

using messaging::ChildProcess;
using testing::AllOf;
using testing::HasSubstr;

const std::string kProgram = FASTBALL_BIN_DIR "/fastball-sim-bullet";

/// What every robot must do, the simulator or another.
class Process : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    endpoint_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                     [this](const heartbeat_t& m) { heartbeat_ = m; });
    ASSERT_TRUE(waitFor([this] { return heartbeat_.state == "idle"; })) << process_.output();
  }
  /// Drains until `done()`, at most 60 s.
  template <class Done>
  bool waitFor(Done done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done() && std::chrono::steady_clock::now() < end) {
      if (endpoint_.drain() == 0)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return done();
  }
  /// A scene without images, which are not what this is about.
  static scene_t scene(int64_t scene_id, double duration) {
    scene_t message = sceneMessage(scene_id, duration);
    message.camera_end = message.camera_start;
    return message;
  }

  messaging::LcmEndpoint endpoint_{messaging::defaultLcmUrl()};
  ChildProcess process_{
      {FASTBALL_BIN_DIR + std::string("/") + GetParam(), "--config", kExperimentFile}};
  ScriptedPeers peers_{endpoint_};
  heartbeat_t heartbeat_{};
};

TEST_P(Process, RunsASceneInLockstepAndEndsOnASignal) {
  peers_.sendScene(scene(1, 0.1));
  ASSERT_TRUE(waitFor([this] { return heartbeat_.state == "finished"; }));
  EXPECT_EQ(heartbeat_.plan_id, 1);
  EXPECT_EQ(peers_.tick(), 99);
  ASSERT_TRUE(waitFor([this] { return peers_.count(sim_truth_t::FINISHED) == 1; }));
  EXPECT_EQ(process_.stop(SIGTERM), 0);
}

TEST_P(Process, RepeatsAStateThatNobodyAnswers) {
  peers_.answers_hand = false;
  peers_.sendScene(scene(1, 0.1));
  ASSERT_TRUE(waitFor([this] { return peers_.arm_states.size() >= 5; }));
  for (const arm_state_t& state : peers_.arm_states)
    EXPECT_EQ(state.tick, 0);
  peers_.answers_hand = true;
  EXPECT_TRUE(waitFor([this] { return heartbeat_.state == "finished"; }));
}

TEST_P(Process, LeavesCommandsForOtherTicksAlone) {
  peers_.answers_arm = false;
  peers_.sendScene(scene(1, 0.1));
  ASSERT_TRUE(waitFor([this] { return peers_.tick() == 0; }));
  arm_command_t command = peers_.armCommand(peers_.arm_states[0]);
  command.tick = 1;
  peers_.sendArm(command);
  command.tick = 0;
  command.scene_id = 9;
  peers_.sendArm(command);
  // Two more repetitions: it has heard them by then.
  const std::size_t said = peers_.arm_states.size();
  ASSERT_TRUE(waitFor([&] { return peers_.arm_states.size() >= said + 2; }));
  EXPECT_EQ(peers_.tick(), 0);
}

TEST_P(Process, SurvivesHostileBytes) {
  const std::string noise = "\x01\x02 these are no messages \xff\xfe";
  for (const char* channel : {"SCENE", "ARM_COMMAND", "HAND_COMMAND"}) {
    endpoint_.publishBytes(channel, noise.data(), noise.size());
    endpoint_.publishBytes(channel, noise.data(), 0);
    endpoint_.publishBytes(channel, std::string(2000, '\x7f').data(), 2000);
  }
  peers_.answers_arm = false;
  peers_.sendScene(scene(1, 0.05));
  ASSERT_TRUE(waitFor([this] { return peers_.tick() == 0; }));
  arm_command_t not_a_number = peers_.armCommand(peers_.arm_states[0]);
  not_a_number.tau[2] = std::numeric_limits<double>::quiet_NaN();
  std::vector<char> bytes(static_cast<std::size_t>(not_a_number.getEncodedSize()));
  not_a_number.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  endpoint_.publishBytes("ARM_COMMAND", bytes.data(), bytes.size());
  const std::size_t said = peers_.arm_states.size();
  ASSERT_TRUE(waitFor([&] { return peers_.arm_states.size() >= said + 2; }));
  EXPECT_EQ(peers_.tick(), 0);
  peers_.answers_arm = true;
  ASSERT_TRUE(waitFor([this] { return heartbeat_.state == "finished"; }));
  EXPECT_GE(heartbeat_.invalid, 7);
}

INSTANTIATE_TEST_SUITE_P(Robots, Process, testing::Values("fastball-sim-bullet", "stand-in-robot"));

TEST(KeyedSimulator, NamesASecondControllerByProcessAndHost) {
  const config::TemporaryFolder folder;
  const std::string path = (folder.path() / "a.key").string();
  const auto key = std::make_shared<const messaging::CommandKey>(messaging::CommandKey::make(path));
  ChildProcess process({kProgram, "--config", kExperimentFile, "--key", path});
  messaging::LcmEndpoint endpoint(messaging::defaultLcmUrl(), key, "controller");
  messaging::LcmEndpoint other(messaging::defaultLcmUrl(), key, "second");
  ScriptedPeers peers(endpoint), second(other);
  peers.answers_hand = second.answers_hand = false;  // the scene stays at its first tick
  second.push = 5;
  heartbeat_t heartbeat{};
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                  [&](const heartbeat_t& m) { heartbeat = m; });
  const auto waitFor = [&](const auto& done, bool with_second) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done() && std::chrono::steady_clock::now() < end) {
      endpoint.drain();
      if (with_second)
        other.drain();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return done();
  };
  ASSERT_TRUE(waitFor([&] { return heartbeat.state == "idle"; }, false)) << process.output();
  scene_t scene = sceneMessage(1, 0.1);
  scene.camera_end = scene.camera_start;
  peers.sendScene(scene);
  ASSERT_TRUE(waitFor([&] { return peers.arm_states.size() >= 3; }, false));
  ASSERT_TRUE(waitFor(
      [&] { return heartbeat.detail.find("of a second sender") != std::string::npos; }, true));
  EXPECT_THAT(heartbeat.detail,
              AllOf(HasSubstr("the first, of second (process " + std::to_string(getpid()) + " on "),
                    HasSubstr("differs from the one before about tick 0")));
  EXPECT_EQ(heartbeat.invalid, 0);
}

TEST(ProcessStart, BadFilesEndWithStatusTwoAndTheirPlace) {
  const config::TemporaryFolder folder;
  const std::string errors = folder.write(
      "errors.yaml", "# what can go wrong\nthrow:\n  grasp_offset: {normal: 5, unit: m}\n");
  ChildProcess with_errors({kProgram, "--config", kExperimentFile, "--uncertainty", errors});
  EXPECT_EQ(with_errors.wait(), 2);
  EXPECT_THAT(with_errors.output(), AllOf(HasSubstr("errors.yaml:3"), HasSubstr("grasp_offset")));
  const std::string file = folder.write("experiment.yaml", "simulatoin: {}\n");
  ChildProcess with_typo({kProgram, "--config", file});
  EXPECT_EQ(with_typo.wait(), 2);
  EXPECT_THAT(with_typo.output(), AllOf(HasSubstr("experiment.yaml:1"), HasSubstr("simulatoin")));
}

}  // namespace
}  // namespace fastball::sim_bullet
