// Commands over LCM between endpoints with one key, with another one, and with none.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <numeric>
#include <thread>
#include <vector>

#include "messaging/command_guard.h"
#include "messaging/lcm_endpoint.h"
#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

using examples::example;
using SteadyClock = std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::shared_ptr<const CommandKey> keyOfByte(uint8_t first) {
  std::array<uint8_t, CommandKey::kBytes> bytes{};
  std::iota(bytes.begin(), bytes.end(), first);
  return std::make_shared<const CommandKey>(bytes);
}

template <class T>
std::vector<uint8_t> encoded(const T& message) {
  std::vector<uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// A robot with a key; each test brings its senders.
class KeyedEndpoint : public ::testing::Test {
 protected:
  KeyedEndpoint() {
    robot_.subscribe<arm_command_t>(kArmCommand, [this](const auto&) { ++commands_; });
    robot_.subscribe<swing_plan_t>(kSwingPlan, [this](const auto& m) { plan_ = m; });
    robot_.subscribe<estop_t>(kEstop, [this](const auto&) { ++estops_; });
    robot_.subscribe<arm_state_t>(kArmState, [this](const auto&) { ++states_; });
  }
  template <class Done>
  bool drainUntil(Done done) {
    const auto end = SteadyClock::now() + std::chrono::seconds(30);
    while (!done() && SteadyClock::now() < end) {
      if (robot_.drain() == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return done();
  }
  int64_t invalid() const { return robot_.counts().at("ARM_COMMAND").invalid; }

  const std::shared_ptr<const CommandKey> key_ = keyOfByte(1);
  LcmEndpoint robot_{defaultLcmUrl(), key_, "robot"};
  int commands_ = 0, estops_ = 0, states_ = 0;
  swing_plan_t plan_{};
};

TEST_F(KeyedEndpoint, HearsWhoHasTheKey) {
  LcmEndpoint sender(defaultLcmUrl(), key_, "controller");
  for (int i = 0; i < 10; ++i)
    ASSERT_TRUE(sender.publish(kArmCommand, example<arm_command_t>()));
  ASSERT_TRUE(sender.publish(kSwingPlan, example<swing_plan_t>()));
  ASSERT_TRUE(drainUntil([&] { return commands_ == 10 && plan_.plan_id != 0; }));
  EXPECT_EQ(plan_.q, example<swing_plan_t>().q);
  EXPECT_EQ(invalid(), 0);
  EXPECT_EQ(robot_.refusals(), "");
  EXPECT_EQ(robot_.keyId(), sender.keyId());
}

TEST_F(KeyedEndpoint, KnowsWhoSaysACommandWhileItIsHandled) {
  LcmEndpoint sender(defaultLcmUrl(), key_, "hand-server");
  std::vector<std::string> senders;
  robot_.subscribe<hand_command_t>(kHandCommand,
                                   [&](const auto&) { senders.push_back(robot_.sender()); });
  robot_.subscribe<hand_state_t>(kHandState,
                                 [&](const auto&) { senders.push_back(robot_.sender()); });
  sender.publish(kHandCommand, example<hand_command_t>());
  sender.publish(kHandState, example<hand_state_t>());
  ASSERT_TRUE(drainUntil([&] { return senders.size() == 2; }));
  EXPECT_THAT(senders[0], HasSubstr(fmt::format("hand-server (process {} on ", getpid())));
  EXPECT_EQ(senders[1], "") << "nothing vouches for a state";
  EXPECT_EQ(robot_.sender(), "");
}

TEST_F(KeyedEndpoint, RefusesCountsAndNamesWhoHasNot) {
  LcmEndpoint bare(defaultLcmUrl()), stranger(defaultLcmUrl(), keyOfByte(2), "gambler");
  bare.publish(kArmCommand, example<arm_command_t>());
  ASSERT_TRUE(drainUntil([&] { return invalid() == 1; }));
  EXPECT_THAT(robot_.refusals(),
              AllOf(HasSubstr("refused 1 ARM_COMMAND; the first has no tag"), HasSubstr("--key")));
  for (int i = 0; i < 7; ++i)
    stranger.publish(kArmCommand, example<arm_command_t>());
  stranger.publish(kSwingPlan, example<swing_plan_t>());
  ASSERT_TRUE(
      drainUntil([&] { return invalid() == 8 && robot_.counts().at("SWING_PLAN").invalid == 1; }));
  EXPECT_THAT(robot_.refusals(), AllOf(HasSubstr("refused 8 ARM_COMMANDs; the first has no tag"),
                                       HasSubstr("refused 1 SWING_PLAN; the first has a wrong tag"),
                                       HasSubstr("gambler (process ")));
  EXPECT_EQ(commands_, 0);
  EXPECT_EQ(plan_.plan_id, 0);
  EXPECT_EQ(bare.keyId(), "");
}

TEST_F(KeyedEndpoint, RefusesWhatItHeardBefore) {
  std::vector<std::vector<uint8_t>> overheard;
  LcmEndpoint listener(defaultLcmUrl());
  listener.subscribeRaw("ARM_COMMAND",
                        [&](const std::string&, const void* data, std::size_t size, int64_t) {
                          const auto* bytes = static_cast<const uint8_t*>(data);
                          overheard.emplace_back(bytes, bytes + size);
                        });
  LcmEndpoint sender(defaultLcmUrl(), key_, "controller");
  for (int i = 0; i < 3; ++i)
    sender.publish(kArmCommand, example<arm_command_t>());
  ASSERT_TRUE(drainUntil([&] {
    listener.drain();
    return commands_ == 3 && overheard.size() == 3;
  }));
  // Sent on by someone without the key, on this channel and on another one.
  LcmEndpoint bare(defaultLcmUrl());
  for (const auto& bytes : overheard)
    bare.publishBytes("ARM_COMMAND", bytes.data(), bytes.size());
  ASSERT_TRUE(drainUntil([&] { return invalid() == 3; }));
  EXPECT_EQ(commands_, 3);
  EXPECT_THAT(robot_.refusals(), HasSubstr("has number 1 after number 3"));
  bare.publishBytes("SWING_PLAN", overheard[0].data(), overheard[0].size());
  ASSERT_TRUE(drainUntil([&] { return robot_.counts().at("SWING_PLAN").invalid == 1; }));
  sender.publish(kArmCommand, example<arm_command_t>());
  EXPECT_TRUE(drainUntil([&] { return commands_ == 4; }));
}

TEST_F(KeyedEndpoint, ARecordedCommandGetsATrailerOfItsOwn) {
  LcmEndpoint replay(defaultLcmUrl(), key_, "replay");
  auto bytes = encoded(example<arm_command_t>());
  ASSERT_TRUE(replay.publishRecorded("ARM_COMMAND", bytes.data(), bytes.size()));
  ASSERT_TRUE(drainUntil([&] { return commands_ == 1; }));
  // As it stands in the log of a keyed run.
  const std::size_t size = bytes.size();
  bytes.resize(size + kTrailerBytes);
  CommandSigner(keyOfByte(9), "controller").sign("ARM_COMMAND", bytes.data(), size, 1);
  ASSERT_TRUE(replay.publishRecorded("ARM_COMMAND", bytes.data(), bytes.size()));
  ASSERT_TRUE(drainUntil([&] { return commands_ == 2; }));
  EXPECT_EQ(invalid(), 0);
}

TEST_F(KeyedEndpoint, TakesAStopAndStatesFromAnyone) {
  LcmEndpoint bare(defaultLcmUrl()), keyed(defaultLcmUrl(), key_, "experiment"),
      stranger(defaultLcmUrl(), keyOfByte(2), "gambler");
  for (LcmEndpoint* sender : {&bare, &keyed, &stranger}) {
    sender->publish(kEstop, example<estop_t>());
    sender->publish(kArmState, example<arm_state_t>());
  }
  EXPECT_TRUE(drainUntil([&] { return estops_ == 3 && states_ == 3; }));
}

TEST_F(KeyedEndpoint, AReceiverWithoutAKeyTakesCommandsWithAndWithoutATrailerAndNothingElse) {
  LcmEndpoint bare_robot(defaultLcmUrl()), sender(defaultLcmUrl(), key_, "controller");
  int heard = 0;
  bare_robot.subscribe<arm_command_t>(kArmCommand, [&](const auto&) { ++heard; });
  bare_robot.subscribe<estop_t>(kEstop, [&](const auto&) { ++heard; });
  sender.publish(kArmCommand, example<arm_command_t>());
  auto bytes = encoded(example<arm_command_t>());
  sender.publishBytes("ARM_COMMAND", bytes.data(), bytes.size());
  const auto& counts = bare_robot.counts();
  const auto await = [&](const char* channel, int64_t invalid) {
    return drainUntil([&] {
      bare_robot.drain();
      return counts.at(channel).invalid == invalid && heard == 2;
    });
  };
  EXPECT_TRUE(await("ARM_COMMAND", 0));
  bytes.resize(bytes.size() + kTrailerBytes);  // of zeros
  sender.publishBytes("ARM_COMMAND", bytes.data(), bytes.size());
  EXPECT_TRUE(await("ARM_COMMAND", 1));
  // Two trailers are one too many, and a stop has none.
  const std::size_t one = bytes.size();
  bytes.resize(one + kTrailerBytes);
  CommandSigner signer(key_, "controller");
  signer.sign("ARM_COMMAND", bytes.data(), one - kTrailerBytes, 1);
  signer.sign("ARM_COMMAND", bytes.data(), one, 1);
  sender.publishBytes("ARM_COMMAND", bytes.data(), bytes.size());
  EXPECT_TRUE(await("ARM_COMMAND", 2));
  auto stop = encoded(example<estop_t>());
  const std::size_t size = stop.size();
  stop.resize(size + kTrailerBytes);
  signer.sign("ESTOP", stop.data(), size, 1);
  sender.publishBytes("ESTOP", stop.data(), stop.size());
  EXPECT_TRUE(await("ESTOP", 1));
}

TEST_F(KeyedEndpoint, ACommandThatLeavesNoRoomForATrailerIsNotSent) {
  LcmEndpoint sender(defaultLcmUrl(), key_, "controller"), bare(defaultLcmUrl());
  const auto command = example<arm_command_t>();
  const Channel<arm_command_t> narrow{"ARM_COMMAND",
                                      static_cast<std::size_t>(command.getEncodedSize())};
  EXPECT_TRUE(bare.publish(narrow, command));
  EXPECT_FALSE(sender.publish(narrow, command));
  EXPECT_EQ(sender.unsent(), 1);
}

}  // namespace
}  // namespace fastball::messaging
