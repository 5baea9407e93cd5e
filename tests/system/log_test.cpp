// What a run leaves behind: its log plays with LCM's own player and with ours, gives the same landing again, and draws itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <boost/process.hpp>
#include <filesystem>
#include <fstream>

#include "logger/log_reader.h"
#include "logger/log_writer.h"
#include "logger/run_record.h"
#include "messaging/lcm_endpoint.h"
#include "tests/system/fastball_run.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;

class RecordedThrow : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome = run_.wait();
    ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
    landing_mm_ = outcome.json["throws"][0]["landing_measured_mm"][0];
  }
  std::string log() const { return run_.logPath(); }

  FastballRun run_{{"run", "--throws", "1", "--seed", "5"}};
  double landing_mm_ = 0;
};

/// Plays a log by `command` and notes what a listener hears.
struct Listener {
  explicit Listener(const std::string& url) : endpoint(url) {
    endpoint.subscribe<landing_t>(messaging::kLanding, [this](const landing_t& m) { landing = m; });
    endpoint.subscribe<arm_command_t>(messaging::kArmCommand,
                                      [this](const arm_command_t&) { ++arm_commands; });
  }
  void listenTo(boost::process::child player) {
    while (player.running()) {
      pollfd waiting{endpoint.fileDescriptor(), POLLIN, 0};
      poll(&waiting, 1, 50);
      endpoint.drain();
    }
    endpoint.drain();
    exit_status = player.exit_code();
  }
  messaging::LcmEndpoint endpoint;
  landing_t landing{};
  int arm_commands = 0;
  int exit_status = -1;
};

TEST_F(RecordedThrow, PlaysWithTheStockPlayer) {
  Listener listener(run_.lcmUrl());
  listener.listenTo(boost::process::child(boost::process::search_path("lcm-logplayer"), "-l",
                                          run_.lcmUrl(), log()));
  EXPECT_EQ(listener.exit_status, 0);
  EXPECT_NEAR(1e3 * listener.landing.landing[0], landing_mm_, 1e-9);
  EXPECT_GT(listener.arm_commands, 1000);
}

TEST_F(RecordedThrow, ReplaysWithoutMovingAnything) {
  Listener listener(run_.lcmUrl());
  listener.listenTo(boost::process::child(FASTBALL_BIN_DIR "/fastball", "replay", log(), "--speed",
                                          "2", "--lcm-url", run_.lcmUrl()));
  EXPECT_EQ(listener.exit_status, 0);
  EXPECT_NEAR(1e3 * listener.landing.landing[0], landing_mm_, 1e-9);
  EXPECT_EQ(listener.arm_commands, 0);
}

TEST_F(RecordedThrow, EveryProcessSaysTheSameAgain) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> processes{
      {"planner", {"SWING_PLAN"}},
      {"controller", {"ARM_COMMAND", "CONTROLLER_STATUS"}},
      {"hand", {"HAND_COMMAND", "GRIP", "RELEASE"}},
      {"tracker", {"BALL_OBSERVATION", "BALL_TRACK", "LANDING"}}};
  for (const auto& [name, channels] : processes) {
    const Outcome rerun = fastball({"replay", log(), "--rerun", name});
    EXPECT_EQ(rerun.exit_status, 0) << rerun.output;
    for (const std::string& channel : channels)
      EXPECT_THAT(rerun.output, testing::ContainsRegex(channel + ": [1-9][0-9]* of"));
    EXPECT_THAT(rerun.output, testing::Not(HasSubstr("different")));
  }
}

TEST_F(RecordedThrow, ALandingThatDiffersInItsLastBitIsFound) {
  const std::string altered = log() + ".altered";
  {
    logger::LogWriter writer(altered);
    logger::readLog(log(), [&](logger::LogEntry entry) {
      landing_t landing{};
      if (entry.channel == "LANDING" && entry.decode(landing)) {
        landing.landing[0] = std::nextafter(landing.landing[0], 1.0);
        landing.encode(entry.data.data(), 0, static_cast<int>(entry.data.size()));
      }
      writer.write(entry.channel, entry.data.data(), entry.data.size(), entry.utime);
    });
  }
  const Outcome rerun = fastball({"replay", altered, "--rerun", "tracker"});
  EXPECT_EQ(rerun.exit_status, 1) << rerun.output;
  EXPECT_THAT(rerun.output,
              HasSubstr("LANDING: 0 of 1 equal, 1 different, first message 1: landing[0] was"));
}

TEST_F(RecordedThrow, DrawsItself) {
  const std::filesystem::path folder = log() + ".report";
  const Outcome report = fastball({"report", log(), "-o", folder.string()});
  EXPECT_EQ(report.exit_status, 0) << report.output;
  EXPECT_GT(std::filesystem::file_size(folder / "throw-1.png"), 10000U);
  EXPECT_GT(std::filesystem::file_size(folder / "throw-1.svg"), 10000U);
  EXPECT_GT(std::filesystem::file_size(folder / "release-1.png"), 10000U);
  EXPECT_GT(std::filesystem::file_size(folder / "release-1.csv"), 10000U);
  EXPECT_GT(std::filesystem::file_size(folder / "release-1.txt"), 100U);
  std::ifstream table(folder / "throws.csv");
  std::string header, line;
  std::getline(table, header);
  std::getline(table, line);
  EXPECT_THAT(line, testing::StartsWith("1,adaptive,"));
}

TEST_F(RecordedThrow, IsFollowedByWhatTheRunWas) {
  std::ifstream file(logger::runRecordPath(log()));
  const auto record = nlohmann::json::parse(file);
  EXPECT_EQ(record.at("seed"), 5);
  EXPECT_THAT(record.at("command_line").get<std::string>(), HasSubstr("--throws 1"));
  EXPECT_TRUE(record.at("configuration").contains("arm/wam4.yaml"));
}

TEST(ReplayInput, AFileThatIsNoLogIsRefused) {
  const Outcome replay = fastball({"replay", FASTBALL_SOURCE_DIR "/README.md"});
  EXPECT_EQ(replay.exit_status, 2);
  EXPECT_THAT(replay.output, HasSubstr("README.md"));
  const Outcome rerun = fastball({"replay", "/no/such.lcmlog", "--rerun", "tracker"});
  EXPECT_EQ(rerun.exit_status, 2);
  EXPECT_THAT(rerun.output, HasSubstr("No such file or directory"));
}

}  // namespace
}  // namespace fastball::system_test
