// Campaigns by an array job of a real Slurm on this host.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "tests/system/campaign_folder.h"
#include "tests/system/local_slurm.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;
constexpr int kThrows = 20;
constexpr int kSetUps = 10;  // of two throws

class Slurm : public testing::Test {
 protected:
  void SetUp() override {
    const std::string why_not = LocalSlurm::whyNot();
    if (!why_not.empty())
      GTEST_SKIP() << why_not;
    slurm_.emplace();
  }
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"--engine", "slurm", "--parts", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return folder_.command(kThrows, words);
  }
  static nlohmann::json localSummary() {
    const CampaignFolder folder;
    const Outcome run = fastball(folder.command(kThrows, {"--jobs", "2"}));
    EXPECT_EQ(run.exit_status, 0) << run.output;
    return folder.summary();
  }

  std::optional<LocalSlurm> slurm_;
  CampaignFolder folder_;
};

TEST_F(Slurm, GivesWhatThisMachinesProcessesGive) {
  const Outcome run = fastball(command());
  EXPECT_EQ(run.exit_status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("has 3 parts"));
  EXPECT_EQ(folder_.lines(), kSetUps);
  EXPECT_EQ(folder_.summary(), localSummary());
}

TEST_F(Slurm, WhatAKilledPartHasNotDoneIsSubmittedAgain) {
  FastballRun run(command());
  folder_.awaitSetUps(run, 1);
  const std::vector<int> parts = folder_.parts();
  ASSERT_FALSE(parts.empty());
  kill(parts.front(), SIGKILL);
  const Outcome ended = run.wait();
  EXPECT_EQ(ended.exit_status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("submitted again"));
  EXPECT_EQ(folder_.lines(), kSetUps);
  EXPECT_EQ(folder_.summary(), localSummary());
}

TEST_F(Slurm, AnInterruptionCancelsTheJobAndTheSameCommandGoesOn) {
  {
    FastballRun run(command());
    folder_.awaitSetUps(run, 1);
    run.signal(SIGINT);
    const Outcome interrupted = run.wait();
    EXPECT_EQ(interrupted.exit_status, 1) << interrupted.output;
    EXPECT_THAT(interrupted.output, HasSubstr("goes on from here"));
    EXPECT_EQ(slurm_->ask("squeue", {"--noheader"}), "");
    EXPECT_THAT(folder_.parts(), testing::IsEmpty());
  }
  const Outcome resumed = fastball(command());
  EXPECT_EQ(resumed.exit_status, 0) << resumed.output;
  EXPECT_EQ(folder_.setUps(), kSetUps);
  EXPECT_EQ(folder_.summary(), localSummary());
}

TEST_F(Slurm, WhatFailsEveryTimeIsNamedWithWhatThePartSaid) {
  const EditedConfig config("experiment.yaml", "experiment", "experiment");
  FastballRun run(command({"--config", config.experiment()}));
  folder_.awaitSetUps(run, 1);
  std::filesystem::remove(config.experiment());
  const Outcome ended = run.wait();
  EXPECT_EQ(ended.exit_status, 1) << ended.output;
  EXPECT_THAT(ended.output, testing::AllOf(HasSubstr("failed 4 times"), HasSubstr("robust seed"),
                                           HasSubstr(config.experiment())));
}

TEST_F(Slurm, ARefusedJobIsSaidInItsOwnWords) {
  const Outcome run = fastball(command({"--sbatch-args", "--partition=nowhere"}));
  EXPECT_EQ(run.exit_status, 1);
  EXPECT_THAT(run.output, testing::AllOf(HasSubstr("Slurm does not take the job"),
                                         HasSubstr("invalid partition")));
}

}  // namespace
}  // namespace fastball::system_test
