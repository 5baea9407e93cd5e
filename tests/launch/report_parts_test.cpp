// What the page of a report is made of: the record of its run, its figures and its words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "config/experiment.h"
#include "launch/recorded_configuration.h"
#include "launch/report/joint_shares.h"
#include "launch/report/logged_run.h"
#include "launch/report/loop_times.h"
#include "launch/report/missing.h"
#include "launch/report/target_face.h"
#include "logger/run_record.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

const std::string kExperiment = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

TEST(RunRecord, IsReadAsItWasWritten) {
  const config::TemporaryFolder folder;
  const std::string log = (folder.path() / "log").string();
  EXPECT_FALSE(logger::readRunRecord(log));
  logger::writeRunRecord(log, {"1.2", "fastball run", kExperiment, 7}, 8);
  const auto record = logger::readRunRecord(log);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->version, "1.2");
  EXPECT_EQ(record->command_line, "fastball run");
  EXPECT_EQ(record->seed, 7);
  EXPECT_EQ(record->start_utime, 8);
  EXPECT_EQ(record->messages, -1);
  EXPECT_TRUE(RecordedConfiguration(log, "").isRecorded());
  EXPECT_EQ(RecordedConfiguration(log, "other.yaml").experiment(), "other.yaml");
}

TEST(RunRecord, ThatMakesNoSenseIsNone) {
  const config::TemporaryFolder folder;
  const std::string log = (folder.path() / "log").string();
  for (const char* text :
       {"", "[]", "{\"config\": 3}", "{\"config\": \"a\", \"configuration\": []}",
        "{\"config\": \"a\", \"configuration\": {\"a\": 3}}"}) {
    folder.write("log.run.json", text);
    EXPECT_FALSE(RecordedConfiguration(log, "").isRecorded()) << text;
    EXPECT_EQ(logger::readRunRecord(log).value_or(logger::WrittenRunRecord{}).seed, 0) << text;
  }
}

TEST(JointShares, OfTheDifferentialAddBothMagnitudes) {
  const config::Experiment experiment = config::loadExperiment(kExperiment);
  arm_state_t state{};
  for (int joint = 0; joint < model::kArmJoints; ++joint) {
    state.qd[joint] = -0.25 * experiment.arm.qd_max[joint];
    state.tau[joint] = 0.5 * experiment.arm.tau_max[joint];
  }
  EXPECT_THAT(speedShares(experiment.arm, state),
              testing::ElementsAre(-0.25, -0.25, -0.25, -0.25, 0.5));
  ThrowRecord record;
  record.arm = {state, arm_state_t{}};
  EXPECT_THAT(peaksOf(record, experiment.arm).torque, testing::ElementsAre(0.5, 0.5, 0.5, 0.5, 1));
  EXPECT_THAT(peaksOf(record, experiment.arm).speed,
              testing::ElementsAre(0.25, 0.25, 0.25, 0.25, 0.5));
}

TEST(LoopTimes, CountHeartbeatsThatNameATime) {
  LoggedProcess process;
  for (const double mean : {0.0, 3.0, 1.0, 2.0}) {
    heartbeat_t beat{};
    beat.loop_mean_us = mean;
    beat.loop_max_us = 10 * mean;
    process.heartbeats.push_back(beat);
  }
  const LoopTimes times = loopTimesOf(process);
  EXPECT_EQ(times.beats, 3);
  EXPECT_EQ(times.median_mean_us, 2);
  EXPECT_EQ(times.largest_mean_us, 3);
  EXPECT_EQ(times.worst_us, 30);
}

TEST(NumberWords, JoinNumbersInARow) {
  EXPECT_EQ(numberWords({}), "");
  EXPECT_EQ(numberWords({4}), "4");
  EXPECT_EQ(numberWords({1, 2}), "1 and 2");
  EXPECT_EQ(numberWords({1, 2, 3, 4, 7, 9, 10, 11}), "1 to 4, 7 and 9 to 11");
}

TEST(RoundStep, IsTheNextRoundNumber) {
  EXPECT_DOUBLE_EQ(roundStep(0.0011), 0.002);
  EXPECT_DOUBLE_EQ(roundStep(0.2), 0.2);
  EXPECT_DOUBLE_EQ(roundStep(3), 5);
  EXPECT_DOUBLE_EQ(roundStep(60), 100);
}

TEST(Ellipse95, IsThatOfTheCovariance) {
  landing_t landing{};
  landing.landing[0] = 0.01;
  landing.cov_landing[0] = 4e-6;
  landing.cov_landing[2] = 1e-6;
  EXPECT_NEAR(extent95(landing).x(), 2e-3 * std::sqrt(5.991), 1e-12);
  std::istringstream outline(ellipse95(landing));
  double x = 0, y = 0;
  int points = 0;
  for (; outline >> x >> y; ++points)
    EXPECT_NEAR(std::pow((x - 10) / 2, 2) + std::pow(y, 2), 5.991, 1e-2);
  EXPECT_GT(points, 36);
}

}  // namespace
}  // namespace fastball::launch
