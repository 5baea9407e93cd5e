// A log said again: what, under which name, when; and how a process's messages are compared with the recorded ones.
#include "launch/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "launch/replay_comparison.h"
#include "logger/log_writer.h"

namespace fastball::launch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class T>
std::vector<char> encoded(const T& message) {
  std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// A user who pauses at the start, for so many looks, and stops after so many messages.
class FakeConsole : public ReplayConsole {
 public:
  void wait(int64_t until_us) override {
    usleep(static_cast<useconds_t>(std::max<int64_t>(until_us - steadyUs(), 0)));
  }
  bool paused() override { return paused_looks-- > 0; }
  bool stopped() override { return said >= stop_after; }
  void show(double its_time, double its_share, int64_t its_said) override {
    time = its_time;
    share = its_share;
    said = its_said;
  }
  int paused_looks = 0;
  int64_t stop_after = std::numeric_limits<int64_t>::max();
  double time = 0, share = 0;
  int64_t said = 0;
};

class Replays : public testing::Test {
 protected:
  void SetUp() override {
    logger::LogWriter writer(log_);
    for (int i = 0; i < 10; ++i) {
      const std::string text = std::to_string(i);
      for (const char* channel : {"IMAGE", "ARM_COMMAND", "ESTOP"})
        writer.write(channel, text.data(), text.size(), 1'000'000 + 10'000 * i);
    }
    endpoint_.subscribeRaw(".*", [this](const std::string& channel, const void* data,
                                        std::size_t size, int64_t /*utime*/) {
      heard_[channel] += std::string(static_cast<const char*>(data), size);
    });
  }
  void TearDown() override { std::filesystem::remove(log_); }

  /// What is heard of a replay, by channel.
  std::map<std::string, std::string> replay(const ReplayOptions& options) {
    said_ = replayLog(log_, options, endpoint_, console_);
    return listen(said_);
  }
  std::map<std::string, std::string> listen(int64_t messages) {
    for (int i = 0; i < 500 && total() < messages; ++i) {
      usleep(10'000);
      endpoint_.drain();
    }
    heard_.erase("LCM_SELF_TEST");
    return heard_;
  }
  int64_t total() const {
    int64_t bytes = 0;
    for (const auto& [channel, text] : heard_)
      bytes += channel == "LCM_SELF_TEST" ? 0 : static_cast<int64_t>(text.size());
    return bytes;
  }

  const std::string log_ =
      testing::TempDir() + "replay_test_" + std::to_string(getpid()) + ".lcmlog";
  messaging::LcmEndpoint endpoint_{messaging::defaultLcmUrl()};
  std::map<std::string, std::string> heard_;
  FakeConsole console_;
  int64_t said_ = 0;
};

TEST_F(Replays, CommandsAreNotSaidUnlessAskedFor) {
  EXPECT_THAT(replay({}), ElementsAre(testing::Pair("IMAGE", "0123456789")));
  ReplayOptions options;
  options.commands = true;
  heard_.clear();
  EXPECT_EQ(replay(options).size(), 3U);
}

TEST_F(Replays, ACommandUnderAnotherNameMovesNothing) {
  ReplayOptions options;
  options.names = {{"ARM_COMMAND", "OLD"}, {"IMAGE", "HAND_COMMAND"}};
  EXPECT_THAT(replay(options), ElementsAre(testing::Pair("OLD", "0123456789")));
}

TEST_F(Replays, OnlyThePartAskedForIsSaid) {
  ReplayOptions options;
  options.part.from = 0.03;
  options.part.to = 0.05;
  options.part.channels = "IM.*";
  EXPECT_THAT(replay(options), ElementsAre(testing::Pair("IMAGE", "345")));
  EXPECT_NEAR(console_.time, 0.05, 1e-9);
}

TEST_F(Replays, NoMessageIsSaidBeforeItsTime) {
  ReplayOptions options;
  options.part.from = 0.02;
  options.speed = 0.5;
  const int64_t start_us = steadyUs();
  replay(options);
  EXPECT_GE(steadyUs() - start_us, 140'000);
}

TEST_F(Replays, APauseHoldsEverythingBack) {
  console_.paused_looks = 3;
  const int64_t start_us = steadyUs();
  EXPECT_THAT(replay({}), ElementsAre(testing::Pair("IMAGE", "0123456789")));
  EXPECT_GE(steadyUs() - start_us, 90'000 + 3 * 50'000);
}

TEST_F(Replays, AStoppedReplaySaysNoMore) {
  console_.stop_after = 4;
  EXPECT_THAT(replay({}), ElementsAre(testing::Pair("IMAGE", "0123")));
  EXPECT_GT(console_.share, 0);
  EXPECT_LT(console_.share, 1);
}

TEST_F(Replays, TheSpaceBarGoesOn) {
  int terminal = -1;
  const pid_t player = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(player, 0);
  if (player == 0) {
    const std::string program = FASTBALL_BIN_DIR "/fastball";
    execl(program.c_str(), program.c_str(), "replay", log_.c_str(), "--pause", "--lcm-url",
          messaging::defaultLcmUrl().c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  std::string shown;
  const auto readSome = [&] {
    std::array<char, 1000> text{};
    const ssize_t n = read(terminal, text.data(), text.size());
    if (n > 0)
      shown.append(text.data(), static_cast<std::size_t>(n));
    return n > 0;
  };
  while (shown.find("paused") == std::string::npos && readSome()) {
  }
  EXPECT_THAT(shown, HasSubstr("paused (space: go on)"));
  usleep(200'000);  // longer than the whole log
  endpoint_.drain();
  EXPECT_EQ(total(), 0);
  EXPECT_EQ(write(terminal, " ", 1), 1);
  while (readSome()) {
  }
  int status = -1;
  EXPECT_EQ(waitpid(player, &status, 0), player);
  close(terminal);
  EXPECT_EQ(status, 0) << shown;
  EXPECT_THAT(listen(10), ElementsAre(testing::Pair("IMAGE", "0123456789")));
  EXPECT_THAT(shown, HasSubstr("replayed 10 messages"));
}

arm_command_t command(int64_t tick, double torque) {
  arm_command_t m{};
  m.tick = tick;
  m.tau[2] = torque;
  return m;
}

TEST(Comparison, EqualMessagesAreCountedWhateverTheirOrderAndSeq) {
  MessageComparison comparison;
  auto said = command(7, 0.5);
  said.seq = 99;
  EXPECT_TRUE(comparison.isPending(comparison.record("ARM_COMMAND", encoded(command(7, 0.5)))));
  EXPECT_TRUE(comparison.isPending(comparison.record("ARM_COMMAND", encoded(command(8, 1.5)))));
  comparison.say("ARM_COMMAND", encoded(command(8, 1.5)));
  comparison.say("ARM_COMMAND", encoded(said));
  EXPECT_EQ(comparison.pending(), 0U);
  EXPECT_EQ(comparisonLine("ARM_COMMAND", comparison.channels().at("ARM_COMMAND")),
            "ARM_COMMAND: 2 of 2 equal");
}

TEST(Comparison, ADifferenceInTheLastBitIsFoundAndNamed) {
  MessageComparison comparison;
  comparison.say("ARM_COMMAND", encoded(command(1, 0.5)));
  comparison.say("ARM_COMMAND", encoded(command(2, 0.5)));
  comparison.record("ARM_COMMAND", encoded(command(1, 0.5)));
  comparison.record("ARM_COMMAND", encoded(command(2, std::nextafter(0.5, 1.0))));
  EXPECT_EQ(comparisonLine("A", comparison.channels().at("ARM_COMMAND")),
            "A: 1 of 2 equal, 1 different, first message 2: tau[2] was 0.5000000000000001, is 0.5");
}

TEST(Comparison, NotANumberEqualsItself) {
  MessageComparison comparison;
  const auto message = encoded(command(1, std::numeric_limits<double>::quiet_NaN()));
  comparison.say("ARM_COMMAND", message);
  comparison.record("ARM_COMMAND", message);
  EXPECT_EQ(comparison.channels().at("ARM_COMMAND").equal, 1);
}

TEST(Comparison, MessagesThatNameNoTickAreComparedInTheirOrder) {
  MessageComparison comparison;
  swing_plan_t first{}, second{};
  second.n_parameters = 1;
  second.parameter_names = {"p"};
  second.parameters = {1};
  comparison.record("SWING_PLAN", encoded(first));
  comparison.record("SWING_PLAN", encoded(first));
  comparison.record("SWING_PLAN", encoded(first));
  first.plan_ms = 3;  // the time it took
  comparison.say("SWING_PLAN", encoded(first));
  comparison.say("SWING_PLAN", encoded(second));
  EXPECT_EQ(comparisonLine("SWING_PLAN", comparison.channels().at("SWING_PLAN")),
            "SWING_PLAN: 1 of 3 equal, 1 different, first message 2: n_parameters was 0, is 1, 1 "
            "not said");
}

}  // namespace
}  // namespace fastball::launch
