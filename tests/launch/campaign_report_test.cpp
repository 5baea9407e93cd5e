// Pictures and tables of a campaign's folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "launch/campaign/campaign_drawing.h"
#include "launch/campaign/campaign_report.h"
#include "launch/campaign/cases.h"
#include "launch/campaign/error_table.h"
#include "tests/config/temporary_folder.h"

namespace fastball::launch {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

const std::string kSource = FASTBALL_SOURCE_DIR;

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Case caseOf(const std::string& strategy,
            const std::string& variant,
            const std::optional<Quantity>& quantity = {}) {
  return {variant.empty() ? strategy : strategy + ", " + variant, strategy,
          kSource + "/config/experiment.yaml", kSource + "/config/uncertainty/paper.yaml",
          quantity};
}

/// Case number i: two set-ups of the throws 0, 10 and 20 mm, and (60 + 20 i) mm to the right, the last never lands.
class CampaignReport : public testing::Test {
 protected:
  void begin(const std::vector<Case>& cases) {
    Campaign campaign;
    campaign.version = "test";
    campaign.throws = 10;
    campaign.set_up_throws = 5;
    campaign.cases = cases;
    beginCampaign(in(), campaign);
    RecordFile file(in(), "part");
    for (const Unit& unit : unitsOf(campaign))
      file.add(resultOf(unit));
  }
  static UnitResult resultOf(const Unit& unit) {
    UnitResult result;
    result.unit = unit;
    for (const double right : {0.0, 0.01, 0.02, 0.06 + 0.02 * unit.case_index}) {
      ThrowOutcome thrown;
      thrown.landing = Eigen::Vector2d(right, 0.001 * unit.set_up);
      thrown.hit = thrown.landing->norm() < 0.1;
      thrown.clean = thrown.landing->norm() < 0.05;
      result.throws.push_back(thrown);
    }
    result.throws.emplace_back();
    return result;
  }
  std::string page() const { return contents(out() + "/index.html"); }
  std::string in() const { return (folder_.path() / "in").string(); }
  std::string out() const { return (folder_.path() / "it's out").string(); }
  void expectPicture(const std::string& name) const {
    SCOPED_TRACE(name);
    EXPECT_EQ(contents(out() + "/" + name + ".png").substr(1, 3), "PNG");
    EXPECT_THAT(contents(out() + "/" + name + ".svg"), HasSubstr("</svg>"));
    EXPECT_THAT(contents(out() + "/" + name + ".csv"), Not(IsEmpty()));
    EXPECT_THAT(contents(out() + "/report.md"), HasSubstr("(" + name + ".svg)"));
    EXPECT_THAT(page(), HasSubstr("<img src=\"./" + name + ".svg\""));
  }
  config::TemporaryFolder folder_;
};

TEST_F(CampaignReport, OfStrategiesHasRatesLandingsAndThrowNumbers) {
  begin({caseOf("paper", ""), caseOf("robust", ""), caseOf("tactile", "")});
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  for (const char* name : {"rates", "landings", "throw-numbers"})
    expectPicture(name);
  EXPECT_FALSE(fs::exists(out() + "/study.csv"));
  EXPECT_THAT(contents(out() + "/rates.csv"), HasSubstr("paper,,10,80.000,49.016,94.332,60.000,"));
  EXPECT_THAT(contents(out() + "/landings.csv"), HasSubstr("robust,,2,4,80.000,1.000,1,0\n"));
  EXPECT_THAT(contents(out() + "/landings.csv"), HasSubstr("robust,,2,5,,,0,0\n"));
  EXPECT_THAT(contents(out() + "/throw-numbers.csv"), HasSubstr("tactile,4,2,0.000,"));
  EXPECT_THAT(contents(out() + "/cases.csv"), HasSubstr("tactile,,10,6,60.000,"));
  EXPECT_THAT(contents(out() + "/report.md"), HasSubstr("| paper | 10 | 80.00 | 49.02 to 94.33 |"));
  EXPECT_THAT(page(), HasSubstr("<td class=\"n\">80.00</td><td class=\"n\">49.02 to 94.33</td>"));
  EXPECT_THAT(page(), HasSubstr("Hits with nothing varied: paper 80.0 % (49.0 to 94.3); robust "));
  EXPECT_THAT(page(), HasSubstr("<code>grasp_offset</code>")) << "the errors";
  EXPECT_THAT(page(), Not(HasSubstr("What is missing")));
}

TEST_F(CampaignReport, ShowsAnyNameAsText) {
  Case hostile = caseOf("<script>\n", "");
  begin({caseOf("paper", ""), hostile});
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  EXPECT_THAT(page(), Not(HasSubstr("<script")));
  EXPECT_THAT(page(), HasSubstr("&lt;script&gt;"));
}

TEST_F(CampaignReport, OfAnOrderedStudyHasItsCurves) {
  begin({caseOf("paper", "", Quantity{"distance (m)", 3}),
         caseOf("robust", "", Quantity{"distance (m)", 3}),
         caseOf("paper", "distance 2 m", Quantity{"distance (m)", 2}),
         caseOf("robust", "distance 2 m", Quantity{"distance (m)", 2})});
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  for (const char* name : {"study", "landings-paper", "landings-robust", "throw-numbers"})
    expectPicture(name);
  const std::string csv = contents(out() + "/study.csv");
  EXPECT_LT(csv.find("distance (m),2,paper,10,60.000,"),
            csv.find("distance (m),3,paper,10,80.000,"))
      << csv;
}

TEST_F(CampaignReport, OfErrorSizesTakesTheUnchangedCaseAsOnce) {
  begin({caseOf("paper", ""), caseOf("paper", "drag x2", Quantity{"drag (times)", 2}),
         caseOf("paper", "friction x2", Quantity{"friction (times)", 2})});
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  expectPicture("study");
  const std::string csv = contents(out() + "/study.csv");
  EXPECT_THAT(csv, HasSubstr("drag (times),1,paper,10,80.000,"));
  EXPECT_THAT(csv, HasSubstr("friction (times),1,paper,10,80.000,"));
}

TEST_F(CampaignReport, OfCausesPutsTheDearestFirst) {
  begin({caseOf("paper", "drag alone"), caseOf("paper", "friction off"), caseOf("paper", ""),
         caseOf("paper", "drag off"), caseOf("paper", "friction alone")});
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  expectPicture("causes-paper");
  const std::string csv = contents(out() + "/causes-paper.csv");
  EXPECT_LT(csv.find("friction,10,80.000,49.016,94.332,20.000,"),
            csv.find("drag,10,60.000,31.267,83.182,0.000,"))
      << csv;
  EXPECT_THAT(page(), HasSubstr("<td class=\"p\">friction</td><td class=\"n\">+20.00</td>"));
}

TEST_F(CampaignReport, OfAnUnfinishedCampaignCountsWhatThereIs) {
  begin({caseOf("paper", ""), caseOf("robust", "")});
  Campaign longer = readCampaign(in());
  for (const auto& file : fs::directory_iterator(in()))
    fs::remove(file);
  longer.throws = 100;
  beginCampaign(in(), longer);
  EXPECT_THROW(writeCampaignReport(in(), out()), std::invalid_argument) << "no throw yet";
  RecordFile(in(), "part").add(resultOf({0, 0, 5}));
  EXPECT_THAT(writeCampaignReport(in(), out()), IsEmpty());
  EXPECT_THAT(contents(out() + "/report.md"), HasSubstr("5 of 200 throws"));
  EXPECT_THAT(contents(out() + "/report.md"), HasSubstr("| robust | 0 |"));
  EXPECT_THAT(page(), HasSubstr("The campaign is not finished: 5 of 200 throws are made."));
}

TEST_F(CampaignReport, NeedsACampaign) {
  EXPECT_THROW(writeCampaignReport(folder_.path(), out()), std::invalid_argument);
}

TEST(RateDifference, IsNewcombesExample) {
  const RateDifference gain = difference({56, 70}, {48, 80});
  EXPECT_NEAR(gain.value, 0.2, 1e-12);
  EXPECT_NEAR(gain.low, 0.0524, 1e-4);
  EXPECT_NEAR(gain.high, 0.3339, 1e-4);
}

TEST(CampaignQuantity, OutlivesTheFileAndMayBeAbsent) {
  const config::TemporaryFolder folder;
  Campaign campaign;
  campaign.cases = {caseOf("paper", "", Quantity{"height (m)", -0.5}), caseOf("robust", "")};
  beginCampaign(folder.path(), campaign);
  const std::vector<Case> cases = readCampaign(folder.path()).cases;
  ASSERT_TRUE(cases[0].quantity);
  EXPECT_EQ(cases[0].quantity->name, "height (m)");
  EXPECT_EQ(cases[0].quantity->value, -0.5);
  EXPECT_FALSE(cases[1].quantity);
}

/// Quantities of a study's cases, none left out.
std::vector<Quantity> quantitiesOf(const std::string& study) {
  const config::TemporaryFolder folder;
  StudyRequest request;
  request.study = study;
  request.strategies = {"paper"};
  request.config = kSource + "/config/experiment.yaml";
  request.uncertainty = kSource + "/config/uncertainty/paper.yaml";
  std::vector<Quantity> quantities;
  for (const Case& one : casesOf(request, folder.path()))
    quantities.push_back(one.quantity.value());
  return quantities;
}

TEST(CampaignQuantity, OfAStudyIncludesTheUnchangedExperiment) {
  for (const char* study : {"scale", "distance", "height", "azimuth", "speed"}) {
    SCOPED_TRACE(study);
    const std::vector<Quantity> quantities = quantitiesOf(study);
    EXPECT_GT(quantities.size(), 4U);
    for (const Quantity& one : quantities)
      EXPECT_EQ(one.name, quantities.front().name);
  }
  EXPECT_EQ(quantitiesOf("scale").front().value, 1);
  EXPECT_EQ(quantitiesOf("distance").front().value, 3);
  EXPECT_EQ(quantitiesOf("height").front().value, -0.5);
  EXPECT_EQ(quantitiesOf("azimuth").front().value, 0);
}

TEST(ErrorTable, NamesPartDistributionUnitAndReason) {
  const config::TemporaryFolder folder;
  const std::string path = folder.write(
      "u.yaml",
      "set_up:\n  drag: {uniform: [-0.1, 0.2], unit: relative, reason: air, times: 2}\n"
      "throw:\n  base_yaw: {half_normal: 0.002, unit: rad, reason: a line}\n");
  const std::string table = errorTable(path);
  EXPECT_THAT(table,
              HasSubstr("| `drag` | set-up | uniform, -0.1 to 0.2, times 2 | relative | air |"));
  EXPECT_THAT(table, HasSubstr("| `base_yaw` | throw | half-normal, sd 0.002 | rad | a line |"));
}

TEST(ErrorTable, InTheDocumentIsThatOfTheFile) {
  EXPECT_THAT(contents(kSource + "/docs/robustness.md"),
              HasSubstr(errorTable(kSource + "/config/uncertainty/paper.yaml")))
      << "docs/robustness.md: put in the table that `fastball report` writes for a campaign";
}

}  // namespace
}  // namespace fastball::launch
