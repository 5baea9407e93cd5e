// Campaigns: who throws what, what is counted, what a kill leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "launch/campaign/cases.h"
#include "launch/campaign/part.h"
#include "launch/campaign/region.h"
#include "launch/campaign/summary.h"
#include "launch/run_setup.h"
#include "sim_bullet/uncertainty.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What is said when `action` fails.
template <class Action>
std::string sentenceOf(const Action& action) {
  try {
    action();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

Campaign twoCases() {
  Campaign campaign;
  campaign.version = "test";
  campaign.throws = 25;
  campaign.set_up_throws = 10;
  campaign.cases = {{"a", "paper", "", ""}, {"b", "robust", "", ""}};
  return campaign;
}

UnitResult resultOf(const Unit& unit, const std::vector<double>& right) {
  UnitResult result;
  result.unit = unit;
  for (const double x : right) {
    ThrowOutcome outcome;
    outcome.landing = Eigen::Vector2d(x, 0);
    outcome.hit = std::abs(x) < 0.1;
    outcome.clean = std::abs(x) < 0.05;
    result.throws.push_back(outcome);
  }
  return result;
}

TEST(Wilson, IsTheKnownIntervalAlsoAtTheEnds) {
  const Rate most{801, 2000};
  EXPECT_NEAR(most.low(), 0.3792, 1e-4);
  EXPECT_NEAR(most.high(), 0.4222, 1e-4);
  EXPECT_NEAR((Rate{10, 10}).low(), 0.7225, 1e-4);
  EXPECT_NEAR((Rate{10, 10}).high(), 1, 1e-12);
  EXPECT_EQ((Rate{0, 10}).low(), 0);
  EXPECT_EQ((Rate{0, 0}).low(), 0);
  EXPECT_EQ((Rate{0, 0}).high(), 1);
}

TEST(CampaignUnits, GiveEveryCaseTheSameSetUpsAndExactlyItsThrows) {
  const std::vector<Unit> units = unitsOf(twoCases());
  ASSERT_EQ(units.size(), 6U);
  int throws[2] = {0, 0};
  for (const Unit& unit : units)
    throws[unit.case_index] += unit.throws;
  EXPECT_THAT(throws, ElementsAre(25, 25));
  EXPECT_EQ(units.back().throws, 5);
}

TEST(CampaignRecord, CountsEachUnitOnceAndNothingHalfWritten) {
  const config::TemporaryFolder folder;
  const std::string path = folder.write("one.jsonl", "");
  const std::string where = folder.path();
  const Unit first{0, 0, 2}, second{1, 0, 2};
  {
    RecordFile file(where, "one");
    file.add(resultOf(first, {0.01, 0.2}));
  }
  std::ofstream(path, std::ios::app) << R"({"case":1,"set_up":0,"thr)";  // killed here
  {
    RecordFile again(where, "one");
    again.add(resultOf(first, {0.01, 0.2}));
    RecordFile other(where, "two");
    other.add(resultOf(second, {0.03, 0.04}));
  }
  std::ofstream(path, std::ios::app) << R"({"case":1,"set_up":9)";
  const auto record = readRecord(where);
  ASSERT_EQ(record.size(), 2U);
  EXPECT_EQ(summarise(record, 0).hits.count, 1);
  EXPECT_EQ(summarise(record, 0).hits.of, 2);
  EXPECT_EQ(summarise(record, 1).cleans.count, 2);
}

TEST(CampaignRecord, SaysWhichLineMakesNoSense) {
  const config::TemporaryFolder folder;
  folder.write("one.jsonl", "{\"case\": 1}\n");
  EXPECT_THAT(sentenceOf([&] { readRecord(folder.path()); }), HasSubstr("one.jsonl:1"));
}

TEST(CampaignSummary, HasBiasScatterAndTheThrowsOfEachNumber) {
  std::map<Unit, UnitResult> record;
  for (int set_up = 0; set_up < 2; ++set_up) {
    const Unit unit{0, set_up, 3};
    record[unit] = resultOf(unit, {0.2, 0.04, 0.06});
  }
  const CaseSummary summary = summarise(record, 0);
  EXPECT_NEAR(summary.bias.x(), 0.1, 1e-12);
  EXPECT_NEAR(summary.covariance(0, 0), 2 * (0.01 + 0.0036 + 0.0016) / 5, 1e-12);
  ASSERT_EQ(summary.by_throw.size(), 3U);
  EXPECT_EQ(summary.by_throw[0].count, 0);
  EXPECT_EQ(summary.by_throw[2].count, 2);
  EXPECT_EQ(summary.settled_hits.of, 2);
  EXPECT_EQ(summary.settled_cleans.count, 0);
}

TEST(CampaignFolder, GoesOnWithItsOwnCampaignAndRefusesAnother) {
  const config::TemporaryFolder folder;
  const std::string where = folder.path() / "campaign";
  Campaign campaign = twoCases();
  beginCampaign(where, campaign);
  beginCampaign(where, campaign);
  EXPECT_NE(writeTodo(where, campaign), "");
  campaign.seed = 2;
  EXPECT_THAT(sentenceOf([&] { beginCampaign(where, campaign); }),
              testing::AllOf(HasSubstr("seed"), HasSubstr(where)));
  EXPECT_THAT(sentenceOf([&] { readCampaign(where + "/none"); }),
              HasSubstr("there is no campaign"));
}

TEST(Region, PlacesAreDrawnByTheSeedWithinTheRegion) {
  const std::string config = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
  const std::vector<Place> places = reachablePlaces(config, 4, 7),
                           again = reachablePlaces(config, 4, 7);
  ASSERT_EQ(places.size(), 4U);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(places[i].distance, again[i].distance);
    EXPECT_GE(places[i].distance, 2);
    EXPECT_LE(places[i].distance, 4);
    EXPECT_LE(std::abs(places[i].azimuth), 1.05);
    EXPECT_LE(std::abs(places[i].height), 0.8);
  }
  EXPECT_NE(reachablePlaces(config, 1, 8)[0].distance, places[0].distance);
}

class CampaignCases : public testing::Test {
 protected:
  std::vector<Case> casesOfStudy(const std::string& study) {
    StudyRequest request;
    request.study = study;
    request.strategies = {"paper", "robust"};
    request.config = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
    request.uncertainty = FASTBALL_SOURCE_DIR "/config/uncertainty/paper.yaml";
    return casesOf(request, folder_.path());
  }
  config::TemporaryFolder folder_;
};

TEST_F(CampaignCases, CausesSwitchEachErrorOffAndLeaveItAlone) {
  const std::vector<Case> cases = casesOfStudy("causes");
  EXPECT_EQ(cases.size(), 2 * (1 + 2 * sim_bullet::kErrors));
  const auto named = [&](const std::string& name) {
    return *std::find_if(cases.begin(), cases.end(),
                         [&](const Case& one) { return one.name == name; });
  };
  using sim_bullet::Error;
  using sim_bullet::Uncertainty;
  const Uncertainty off = sim_bullet::loadUncertainty(named("paper, grasp_offset off").uncertainty);
  EXPECT_EQ(off.of(Uncertainty::kThrow, Error::kGraspOffset).size, 0);
  EXPECT_GT(off.of(Uncertainty::kThrow, Error::kOpeningDelay).size, 0);
  const Uncertainty alone =
      sim_bullet::loadUncertainty(named("paper, grasp_offset alone").uncertainty);
  EXPECT_GT(alone.of(Uncertainty::kThrow, Error::kGraspOffset).size, 0);
  EXPECT_EQ(alone.of(Uncertainty::kThrow, Error::kOpeningDelay).size, 0);
}

TEST_F(CampaignCases, EveryStudyGivesFilesThatTheExperimentReads) {
  for (const std::string& study : studyNames()) {
    for (const Case& one : casesOfStudy(study)) {
      SCOPED_TRACE(one.name);
      sim_bullet::loadUncertainty(one.uncertainty);
      RunOptions options;
      options.config = one.config;
      options.uncertainty = one.uncertainty;
      options.no_network = true;
      EXPECT_NO_THROW(prepareRun(options));
    }
  }
}

TEST_F(CampaignCases, AThrowOfACampaignIsThatOfARunWithTheSameSeed) {
  Campaign campaign;
  campaign.throws = campaign.set_up_throws = 2;
  campaign.seed = 41;
  campaign.cases = {casesOfStudy("none").back()};
  const UnitResult one = runUnit(campaign, {0, 1, 2}), again = runUnit(campaign, {0, 1, 2});
  ASSERT_EQ(one.throws.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_TRUE(one.throws[k].landing);
    EXPECT_EQ(*one.throws[k].landing, *again.throws[k].landing);
  }
  EXPECT_NE(*one.throws[0].landing, *one.throws[1].landing);
}

}  // namespace
}  // namespace fastball::launch
