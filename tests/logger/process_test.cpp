// The logger as a real process: it hears everything that a peer says, bursts included, and ends with a readable file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <boost/process.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "logger/log_reader.h"
#include "logger/run_record.h"
#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"

namespace fastball {
namespace {

using namespace std::chrono_literals;
namespace process = boost::process;

/// Drains the endpoint until the condition holds. @return false after 20 s.
template <class Condition>
bool waitFor(messaging::Endpoint& endpoint, Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    endpoint.drain();
    if (condition())
      return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

class LoggerProcess : public testing::Test {
 protected:
  void SetUp() override {
    log_ = (std::filesystem::path(testing::TempDir()) /
            (std::string("logger_") + std::to_string(getpid()) + ".lcmlog"))
               .string();
    peer_.subscribe<logger_status_t>(messaging::kLoggerStatus,
                                     [this](const logger_status_t& m) { status_ = m; });
  }
  void start(const std::vector<std::string>& flags = {}) {
    std::vector<std::string> arguments{
        "--log", log_, "--seed", "4", "--config", FASTBALL_SOURCE_DIR "/config/experiment.yaml"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    logger_ = process::child(process::exe = FASTBALL_BIN_DIR "/fastball-logger",
                             process::args = arguments, process::std_out > process::null,
                             process::std_err > errors_);
    ASSERT_TRUE(waitFor(peer_, [this] { return status_.utime > 0; }));
  }
  void say(int states) {
    for (int tick = 0; tick < states; ++tick) {
      arm_state_t state{};
      state.tick = tick;
      ASSERT_TRUE(states_.publish(state));
    }
  }
  std::string errors() { return {std::istreambuf_iterator<char>(errors_), {}}; }
  void TearDown() override {
    std::filesystem::remove(log_);
    std::filesystem::remove(logger::runRecordPath(log_));
  }
  void endLogger(int signal) {
    kill(logger_.id(), signal);
    logger_.wait();
  }
  int count(const std::string& channel) const {
    int messages = 0;
    logger::readLog(log_,
                    [&](const logger::LogEntry& entry) { messages += entry.channel == channel; });
    return messages;
  }

  messaging::LcmEndpoint peer_{messaging::defaultLcmUrl()};
  messaging::Publisher<arm_state_t> states_{peer_, messaging::kArmState};
  logger_status_t status_{};
  std::string log_;
  process::ipstream errors_;
  process::child logger_;
};

TEST_F(LoggerProcess, ABurstOfAThousandIsAllThere) {
  start();
  say(1000);
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.messages >= 1000; }));
  endLogger(SIGINT);
  EXPECT_EQ(logger_.exit_code(), 0);
  EXPECT_EQ(count("ARM_STATE"), 1000);
  EXPECT_GE(count("LOGGER_STATUS"), 1);
  EXPECT_EQ(status_.lost, 0);
}

TEST_F(LoggerProcess, BytesThatAreNoMessageAreLoggedAsTheyCame) {
  start();
  const char bytes[] = "\x01\x02\x03";
  peer_.publishBytes("ODD", bytes, 3);
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.bytes > 0; }));
  endLogger(SIGTERM);
  EXPECT_EQ(count("ODD"), 1);
}

/// [us] how much of what was said last a killed logger has not on the disk.
int64_t lostWhenKilled(const std::string& log, int64_t killed_utime) {
  int64_t last_utime = 0;
  logger::readLog(log, [&](const logger::LogEntry& entry) {
    if (entry.channel == "ARM_STATE")
      last_utime = entry.utime;
  });
  return killed_utime - last_utime;
}

TEST_F(LoggerProcess, AKilledLoggerLosesATenthOfASecondAtMost) {
  // A busy machine may keep the logger from running for longer than that; a logger that flushes too late never does it in time.
  int64_t least = INT64_MAX;
  for (int trial = 0; trial < 10 && least > 100'000; ++trial) {
    status_ = {};
    ASSERT_NO_FATAL_FAILURE(start());
    for (int i = 0; i < 400; ++i) {
      say(1);
      std::this_thread::sleep_for(1ms);
    }
    const int64_t now = messaging::SystemClock().wallUs();
    endLogger(SIGKILL);
    least = std::min(least, lostWhenKilled(log_, now));
  }
  EXPECT_LE(least, 100'000);
}

TEST_F(LoggerProcess, OnlyTheChannelsAskedForAreLogged) {
  start({"--channel", "ARM_.*|HEARTBEAT|LOGGER_STATUS", "--exclude", "HEART.*"});
  say(3);
  peer_.publishBytes("CHARM_STATE", "abc", 3);
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.messages >= 4; }));
  endLogger(SIGINT);
  EXPECT_EQ(count("ARM_STATE"), 3);
  EXPECT_EQ(count("CHARM_STATE"), 0);
  EXPECT_EQ(count("HEARTBEAT"), 0);
}

TEST_F(LoggerProcess, AFullDiskIsSaidOnceAndWritingGoesOnWhenThereIsRoom) {
  start();
  rlimit limit{};
  ASSERT_EQ(prlimit(logger_.id(), RLIMIT_FSIZE, nullptr, &limit), 0);
  const rlimit full{10000, limit.rlim_max};
  ASSERT_EQ(prlimit(logger_.id(), RLIMIT_FSIZE, &full, nullptr), 0);
  say(1000);
  ASSERT_TRUE(waitFor(peer_, [this] { return !status_.message.empty(); }));
  EXPECT_THAT(status_.message, testing::HasSubstr("File too large"));
  ASSERT_EQ(prlimit(logger_.id(), RLIMIT_FSIZE, &limit, nullptr), 0);
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.messages >= 1000; }));
  EXPECT_EQ(status_.message, "");
  endLogger(SIGINT);
  EXPECT_EQ(count("ARM_STATE"), 1000);
  const std::string said = errors();
  const auto first = said.find("File too large");
  EXPECT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("File too large", first + 1), std::string::npos) << said;
  EXPECT_THAT(said, testing::HasSubstr("goes on"));
}

TEST_F(LoggerProcess, WhatIsDroppedIsSaidAndRecorded) {
  start({"--buffer-mb", "1"});
  const rlimit full{0, RLIM_INFINITY};
  ASSERT_EQ(prlimit(logger_.id(), RLIMIT_FSIZE, &full, nullptr), 0);
  const std::string image(100'000, 'i');
  int64_t said = 0;
  ASSERT_TRUE(waitFor(peer_, [&] {
    peer_.publishBytes("IMAGE", image.data(), image.size());
    ++said;
    return status_.message.find("dropped") != std::string::npos;
  }));
  EXPECT_GT(status_.lost, 0);
  EXPECT_THAT(status_.message, testing::HasSubstr("IMAGE from "));
  const rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(prlimit(logger_.id(), RLIMIT_FSIZE, &room, nullptr), 0);
  endLogger(SIGINT);
  std::ifstream file(logger::runRecordPath(log_));
  const auto record = nlohmann::json::parse(file);
  const auto& dropped = record.at("recording").at("dropped").at("IMAGE");
  EXPECT_EQ(dropped.at("messages").get<int64_t>() + count("IMAGE"), said);
  EXPECT_LE(dropped.at("first_utime"), dropped.at("last_utime"));
  EXPECT_THAT(errors(), testing::HasSubstr("IMAGE from "));
}

TEST(LoggerStart, AnExpressionThatDoesNotParseEndsWithStatus2) {
  process::child logger(FASTBALL_BIN_DIR "/fastball-logger", "--log",
                        testing::TempDir() + "/never.lcmlog", "--channel", "(",
                        process::std_out > process::null, process::std_err > process::null);
  logger.wait();
  EXPECT_EQ(logger.exit_code(), 2);
}

TEST(LoggerStart, AnUnwritablePathEndsWithStatus2AndItsName) {
  process::ipstream errors;
  process::child logger(FASTBALL_BIN_DIR "/fastball-logger", "--log", "/no/such/folder/a.lcmlog",
                        process::std_out > process::null, process::std_err > errors);
  std::string text, line;
  while (std::getline(errors, line))
    text += line + "\n";
  logger.wait();
  EXPECT_EQ(logger.exit_code(), 2);
  EXPECT_THAT(text, testing::HasSubstr("/no/such/folder/a.lcmlog"));
}

}  // namespace
}  // namespace fastball
