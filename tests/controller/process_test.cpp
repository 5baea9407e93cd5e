// The controller as a real process over LCM, with this test as its robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/controller/closed_loop.h"
#include "tests/controller/messages.h"
#include "tests/messaging/child_process.h"

namespace fastball::controller {
namespace {

using ::testing::HasSubstr;

class ControllerProcess : public testing::Test {
 protected:
  ControllerProcess() {
    peer_.subscribe<arm_command_t>(messaging::kArmCommand,
                                   [this](const arm_command_t& m) { command_ = m; });
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
  bool tick(int64_t tick) {
    const bool answered = sayUntil(messaging::kArmState, stateMessage(1, tick, robot_.q, robot_.qd),
                                   [&] { return command_.tick == tick && command_.scene_id == 1; });
    robot_.tick(Eigen::Map<const Eigen::Vector4d>(command_.tau));
    return answered;
  }
  bool reaches(const std::string& state) {
    return heartbeat_.name == "controller" && heartbeat_.state == state;
  }

  messaging::LcmEndpoint peer_{messaging::defaultLcmUrl()};
  messaging::ChildProcess process_{
      {FASTBALL_BIN_DIR "/fastball-controller", "--config", kExperimentPath}};
  arm_command_t command_{};
  heartbeat_t heartbeat_{};
  SimulatedArm robot_{testArm(), kBack};
};

TEST_F(ControllerProcess, SwingsAnArm) {
  ASSERT_TRUE(sayUntil(messaging::kSwingPlan, planMessage(swingPlan()),
                       [&] { return reaches("planned"); }));
  ASSERT_TRUE(sayUntil(messaging::kThrowStart, startMessage(1, 1, 100'000),
                       [&] { return reaches("armed"); }));
  for (int i = 0; i <= 1150; ++i)
    ASSERT_TRUE(tick(i));
  EXPECT_EQ(command_.phase, int{arm_command_t::HOLD});
  EXPECT_LT((robot_.q - kFront).norm(), 1e-3);
  EXPECT_EQ(process_.stop(SIGINT), 0);
}

TEST_F(ControllerProcess, OutlivesHostileBytes) {
  ASSERT_TRUE(tick(0));
  std::mt19937 random(3);
  std::vector<uint8_t> bytes;
  for (int i = 0; i < 300; ++i) {
    bytes.resize(random() % 2000);
    for (uint8_t& byte : bytes)
      byte = static_cast<uint8_t>(random());
    for (const char* channel : {"ARM_STATE", "SWING_PLAN", "THROW_START", "GRIP", "ESTOP"})
      peer_.publishBytes(channel, bytes.data(), bytes.size());
  }
  arm_state_t not_finite = stateMessage(1, 1, robot_.q, robot_.qd);
  not_finite.q[2] = std::numeric_limits<double>::quiet_NaN();
  std::vector<uint8_t> encoded(static_cast<std::size_t>(not_finite.getEncodedSize()));
  not_finite.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
  peer_.publishBytes("ARM_STATE", encoded.data(), encoded.size());
  EXPECT_TRUE(tick(1));
  EXPECT_TRUE(std::isfinite(command_.tau[2]));
  EXPECT_EQ(process_.stop(SIGTERM), 0);
}

TEST(ControllerProgram, ABadExperimentFileIsStatusTwo) {
  messaging::ChildProcess process({FASTBALL_BIN_DIR "/fastball-controller", "--config",
                                   FASTBALL_SOURCE_DIR "/config/ball.yaml"});
  EXPECT_EQ(process.wait(), 2);
  EXPECT_THAT(process.output(), HasSubstr("ball.yaml"));
}

}  // namespace
}  // namespace fastball::controller
