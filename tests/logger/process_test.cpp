// The logger as a real process: it hears everything that a peer says, bursts included, and ends with a readable file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <boost/process.hpp>
#include <chrono>
#include <filesystem>
#include <thread>

#include "logger/log_reader.h"
#include "logger/run_record.h"
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
    logger_ = process::child(FASTBALL_BIN_DIR "/fastball-logger", "--log", log_, "--seed", "4",
                             "--config", FASTBALL_SOURCE_DIR "/config/experiment.yaml",
                             process::std_out > process::null);
    ASSERT_TRUE(waitFor(peer_, [this] { return status_.path == log_; }));
  }
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
  process::child logger_;
};

TEST_F(LoggerProcess, ABurstOfAThousandIsAllThere) {
  for (int tick = 0; tick < 1000; ++tick) {
    arm_state_t state{};
    state.tick = tick;
    ASSERT_TRUE(states_.publish(state));
  }
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.messages >= 1000; }));
  endLogger(SIGINT);
  EXPECT_EQ(logger_.exit_code(), 0);
  EXPECT_EQ(count("ARM_STATE"), 1000);
  EXPECT_GE(count("LOGGER_STATUS"), 1);
  EXPECT_EQ(status_.lost, 0);
}

TEST_F(LoggerProcess, BytesThatAreNoMessageAreLoggedAsTheyCame) {
  const char bytes[] = "\x01\x02\x03";
  peer_.publishBytes("ODD", bytes, 3);
  ASSERT_TRUE(waitFor(peer_, [this] { return status_.bytes > 0; }));
  endLogger(SIGTERM);
  EXPECT_EQ(count("ODD"), 1);
}

TEST_F(LoggerProcess, AKilledLoggerLeavesAReadableLog) {
  arm_state_t state{};
  states_.publish(state);
  // Flushed every 100 ms; two statuses later that has happened.
  const int64_t before = status_.seq;
  ASSERT_TRUE(waitFor(peer_, [&] { return status_.seq >= before + 2; }));
  endLogger(SIGKILL);
  EXPECT_EQ(count("ARM_STATE"), 1);
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
