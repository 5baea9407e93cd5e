// The hand server as a real process over LCM, with this test as its hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/hand_server/messages.h"
#include "tests/hand_server/scripted_hand.h"
#include "tests/messaging/child_process.h"

namespace fastball::hand_server {
namespace {

using ::testing::HasSubstr;

class HandServerProcess : public testing::Test {
 protected:
  HandServerProcess() {
    peer_.subscribe<hand_command_t>(messaging::kHandCommand,
                                    [this](const hand_command_t& m) { command_ = m; });
    peer_.subscribe<release_t>(messaging::kRelease, [this](const release_t& m) { release_ = m; });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                 [this](const heartbeat_t& m) { heartbeat_ = m; });
  }
  /// Says a message every 20 ms, as all peers do, until `done()`. @return false after 20 s.
  template <class T, class Done>
  bool sayUntil(const messaging::Channel<T>& channel, const T& message, Done done) {
    for (int i = 0; i < 1000; ++i) {
      peer_.publish(channel, message);
      for (int wait = 0; wait < 200; ++wait) {
        peer_.drain();
        if (done())
          return true;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    }
    return false;
  }
  bool tick(int64_t tick, double force) {
    const bool answered =
        sayUntil(messaging::kHandState, stateMessage(1, tick, hand_.q, hand_.qd, force),
                 [&] { return command_.tick == tick && command_.scene_id == 1; });
    hand_.tick(answerOf(command_));
    return answered;
  }
  bool reaches(const std::string& state) {
    return heartbeat_.name == "hand_server" && heartbeat_.state == state;
  }

  messaging::LcmEndpoint peer_{messaging::defaultLcmUrl()};
  messaging::ChildProcess process_{
      {FASTBALL_BIN_DIR "/fastball-hand-server", "--config", kExperimentPath}};
  hand_command_t command_{};
  release_t release_{};
  heartbeat_t heartbeat_{};
  ScriptedHand hand_;
};

TEST_F(HandServerProcess, ThrowsABall) {
  ASSERT_TRUE(sayUntil(messaging::kSwingPlan, planMessage(throwPlan()),
                       [&] { return reaches("planned"); }));
  ASSERT_TRUE(sayUntil(messaging::kThrowStart, startMessage(1, 1, 300'000),
                       [&] { return reaches("armed"); }));
  for (int i = 0; i < 850; ++i)
    ASSERT_TRUE(tick(i, i <= 808 ? 2.0 : 0.0));
  EXPECT_EQ(command_.phase, int{hand_command_t::CLEAR});
  EXPECT_EQ(release_.event, int{release_t::DEPARTED});
  EXPECT_NEAR(static_cast<double>(release_.utime), 808e3 - 1e3, 1e3)
      << "about the last state with a touch, less the sensors' delay";
  EXPECT_EQ(process_.stop(SIGINT), 0);
}

TEST_F(HandServerProcess, OutlivesHostileBytes) {
  ASSERT_TRUE(tick(0, 0));
  std::mt19937 random(4);
  std::vector<uint8_t> bytes;
  for (int i = 0; i < 300; ++i) {
    bytes.resize(random() % 2000);
    for (uint8_t& byte : bytes)
      byte = static_cast<uint8_t>(random());
    for (const char* channel : {"HAND_STATE", "ARM_STATE", "SWING_PLAN", "THROW_START", "ESTOP"})
      peer_.publishBytes(channel, bytes.data(), bytes.size());
  }
  EXPECT_TRUE(tick(1, 0));
  EXPECT_EQ(process_.stop(SIGTERM), 0);
}

TEST(HandServerProgram, ABadExperimentFileIsStatusTwo) {
  messaging::ChildProcess process({FASTBALL_BIN_DIR "/fastball-hand-server", "--config",
                                   FASTBALL_SOURCE_DIR "/config/ball.yaml"});
  EXPECT_EQ(process.wait(), 2);
  EXPECT_THAT(process.output(), HasSubstr("ball.yaml"));
}

}  // namespace
}  // namespace fastball::hand_server
