// Campaigns by real processes: what an interruption or a kill leaves, and a campaign's throws made again by the experiment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "launch/campaign/part.h"
#include "launch/run_config.h"
#include "tests/system/campaign_folder.h"

namespace fastball::system_test {
namespace {

using testing::HasSubstr;
constexpr int kThrows = 16;
constexpr int kSetUps = 8;  // of two throws

nlohmann::json undisturbedSummary() {
  const CampaignFolder folder;
  const Outcome run = fastball(folder.command(kThrows, {"--jobs", "1"}));
  EXPECT_EQ(run.exit_status, 0) << run.output;
  return folder.summary();
}

TEST(CampaignRuns, AnInterruptedOneGoesOnWithNothingLostOrMadeTwice) {
  const CampaignFolder folder;
  const auto command = folder.command(kThrows, {"--jobs", "2"});
  int before = 0;
  {
    FastballRun run(command);
    folder.awaitSetUps(run, 2);
    run.signal(SIGINT);
    const Outcome interrupted = run.wait();
    before = folder.setUps();
    EXPECT_GE(before, 2);
    EXPECT_EQ(interrupted.exit_status == 0, before == kSetUps) << interrupted.output;
    if (before < kSetUps) {
      EXPECT_THAT(interrupted.output, HasSubstr("goes on from here"));
    }
    EXPECT_THAT(folder.parts(), testing::IsEmpty());
  }
  const Outcome resumed = fastball(command);
  EXPECT_EQ(resumed.exit_status, 0) << resumed.output;
  EXPECT_EQ(folder.setUps(), kSetUps);
  EXPECT_EQ(folder.lines(), kSetUps);
  EXPECT_EQ(folder.summary(), undisturbedSummary());
}

TEST(CampaignRuns, AKilledPartLosesItsOwnSetUpAlone) {
  const CampaignFolder folder;
  const auto command = folder.command(kThrows, {"--jobs", "2"});
  {
    FastballRun run(command);
    folder.awaitSetUps(run, 1);
    const std::vector<int> parts = folder.parts();
    if (!parts.empty())
      kill(parts.front(), SIGKILL);
    const Outcome killed = run.wait();
    const int done = folder.setUps();
    // The other part does all of its own.
    EXPECT_GE(done, kSetUps / 2);
    EXPECT_EQ(killed.exit_status == 0, done == kSetUps) << killed.output;
    if (done < kSetUps) {
      EXPECT_THAT(killed.output, HasSubstr("signal 9"));
    }
  }
  const Outcome resumed = fastball(command);
  EXPECT_EQ(resumed.exit_status, 0) << resumed.output;
  EXPECT_EQ(folder.lines(), kSetUps);
  EXPECT_EQ(folder.summary(), undisturbedSummary());
}

TEST(CampaignRuns, AHandThatFeelsTheBallHasTheArmMakeGoodWhatItIsOffItsPlace) {
  const CampaignFolder folder;
  const config::TemporaryFolder files;
  const std::string errors =
      files.write("grasp.yaml", "throw:\n  grasp_offset: {normal: 0.003, unit: m, reason: far}\n");
  const Outcome run = fastball({"campaign", "--strategy", "robust,tactile", "--throws", "12",
                                "--seed", "1", "--uncertainty", errors, "--folder", folder.path()});
  ASSERT_EQ(run.exit_status, 0) << run.output;
  const nlohmann::json strategies = folder.summary().at("strategies");
  for (int axis = 0; axis < 2; ++axis) {
    const auto scatter = [&](const char* strategy) {
      return strategies.at(strategy).at("sigma_mm").at(axis).get<double>();
    };
    EXPECT_LT(scatter("tactile"), 0.6 * scatter("robust")) << (axis == 0 ? "to the right" : "up");
  }
}

TEST(CampaignRuns, NoSlurmHereIsSaidInOneSentence) {
  const CampaignFolder folder;
  const Outcome run =
      fastball(folder.command(2, {"--engine", "slurm"}), {"env", "PATH=/var/empty"});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.output, HasSubstr("there is no program 'sbatch' here"));
}

/// A set-up of a campaign, and the same throws made by all processes over LCM.
class SetUpAgain : public testing::TestWithParam<std::string> {};

TEST_P(SetUpAgain, LandsTheSameBitForBit) {
  constexpr int kSetUp = 4;
  const std::string errors = FASTBALL_SOURCE_DIR "/config/uncertainty/paper.yaml";
  launch::Campaign campaign;
  campaign.throws = campaign.set_up_throws = GetParam() == "adaptive" ? 4 : 2;
  campaign.seed = 30;
  campaign.cases = {
      {GetParam(), GetParam(), FASTBALL_SOURCE_DIR "/config/experiment.yaml", errors}};
  const launch::UnitResult unit = launch::runUnit(campaign, {0, kSetUp, campaign.throws});
  const Outcome run = fastball({"run", "--seed", std::to_string(campaign.seed + kSetUp), "--throws",
                                std::to_string(campaign.throws), "--no-images", "--uncertainty",
                                errors, "--strategy", GetParam()});
  ASSERT_EQ(run.exit_status, 0) << run.output;
  ASSERT_EQ(run.json["throws"].size(), unit.throws.size());
  int landed = 0;
  for (std::size_t k = 0; k < unit.throws.size(); ++k) {
    const launch::ThrowOutcome& thrown = unit.throws[k];
    const nlohmann::json& again = run.json["throws"][k];
    EXPECT_EQ(again["hit"], thrown.hit);
    EXPECT_EQ(again["landing_true_mm"].is_null(), !thrown.landing);
    EXPECT_EQ(again["landing_measured_mm"].is_null(), !thrown.measured);
    for (int axis = 0; axis < 2 && thrown.landing && thrown.measured; ++axis) {
      EXPECT_EQ(again["landing_true_mm"][axis].get<double>(), 1e3 * (*thrown.landing)[axis]);
      EXPECT_EQ(again["landing_measured_mm"][axis].get<double>(), 1e3 * (*thrown.measured)[axis]);
    }
    landed += thrown.landing && thrown.measured ? 1 : 0;
  }
  EXPECT_GT(landed, 0);
}

INSTANTIATE_TEST_SUITE_P(Strategies,
                         SetUpAgain,
                         testing::ValuesIn(launch::kStrategies),
                         [](const auto& strategy) { return strategy.param; });

}  // namespace
}  // namespace fastball::system_test
