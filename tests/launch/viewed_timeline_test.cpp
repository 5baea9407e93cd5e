// What viewers see of an experiment: its time, its samples, its throws, and what is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <regex>

#include "launch/view/frame.h"
#include "launch/view/missing.h"
#include "launch/view/viewed_log.h"
#include "tests/launch/view_messages.h"

namespace fastball::view {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TimeAxis, InsideASceneItIsSimulatedTimeWhateverTheTimeOfReceipt) {
  TimeAxis axis;
  axis.receive(kWallUs);
  axis.receive(kWallUs + 2'000'000);
  EXPECT_DOUBLE_EQ(axis.now(), 2);
  axis.state(1, 10'000'000);
  axis.receive(kWallUs + 50'000'000);
  axis.state(1, 10'500'000);
  EXPECT_NEAR(axis.now(), 2.5, 1e-9);
}

TEST(TimeAxis, ScenesFollowEachOtherAlsoThoseOfAnotherRun) {
  TimeAxis axis;
  axis.state(1, 10'000'000);
  axis.state(1, 13'000'000);
  axis.state(2, 20'000'000);
  EXPECT_NEAR(axis.now(), 3 + TimeAxis::kBetweenScenes, 1e-9);
  axis.state(2, 21'000'000);
  axis.state(2, 20'999'000);  // overtaken by its successor
  EXPECT_NEAR(axis.now(), 4 + TimeAxis::kBetweenScenes, 1e-9);
  EXPECT_EQ(axis.scenes(), 2);
  axis.state(2, 20'000'000);  // another run's second scene
  EXPECT_NEAR(axis.now(), 4 + 2 * TimeAxis::kBetweenScenes, 1e-9);
  EXPECT_EQ(axis.scenes(), 3);
}

TEST(Kept, NumbersStayWhenTheOldestAreForgotten) {
  Kept<int> kept(3);
  for (int i = 0; i < 5; ++i)
    kept.push(10 * i);
  EXPECT_EQ(kept.first(), 2);
  EXPECT_EQ(kept.end(), 5);
  EXPECT_EQ(kept.at(1), nullptr);
  EXPECT_EQ(*kept.at(4), 40);
  EXPECT_EQ(kept.at(5), nullptr);
}

class ATimeline : public testing::Test {
 protected:
  Timeline timeline_{defaultExperiment(), kFloor};
  void tick(int64_t scene_id, int64_t tick) {
    take(timeline_, messaging::kArmState, armState(scene_id, tick));
    take(timeline_, messaging::kHandState, handState(scene_id, tick));
  }
  float value(int64_t sample, int which) const {
    return timeline_.samples().at(sample)->values.at(static_cast<std::size_t>(which));
  }
};

TEST_F(ATimeline, MakesOneSampleOfATickHoweverOftenItIsSaid) {
  for (int i = 0; i < 4; ++i) {
    tick(1, i);
    tick(1, i);
  }
  ASSERT_EQ(timeline_.samples().end(), 3);  // the last one is not over
  EXPECT_NEAR(timeline_.samples().at(2)->t - timeline_.samples().at(0)->t, 0.002, 1e-9);
  EXPECT_FLOAT_EQ(value(1, kSpeed + 2), 2.1F);
  EXPECT_FLOAT_EQ(value(1, kTorque), -0.1F);
  EXPECT_FLOAT_EQ(value(1, kNormal + 1), 6);
  EXPECT_FLOAT_EQ(value(1, kTangential + 1), 5);
}

TEST_F(ATimeline, DrawsArmAndHandWhereTheModelHasThem) {
  tick(1, 0);
  tick(1, 1);
  const config::Experiment& experiment = defaultExperiment();
  const model::Arm arm(experiment.arm);
  const model::Hand hand(experiment.hand);
  const model::Vector4 q = model::Vector4::Constant(0.1);
  const Eigen::Vector3d p_WBall = arm.X_WT(q) * (hand.X_TH(0, 0) * experiment.hand.p_HBall);
  const Eigen::Vector3d p_WPlate = arm.X_WT(q).translation();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(value(0, kPoints + 3 * kHeldBall + i), p_WBall[i], 1e-6);
    EXPECT_NEAR(value(0, kPoints + 3 * kToolPlate + i), p_WPlate[i], 1e-6);
  }
}

TEST_F(ATimeline, KeepsTheHandOverALostStateAndNoLonger) {
  tick(1, 0);
  for (int i = 1; i < 40; ++i)
    take(timeline_, messaging::kArmState, armState(1, i));
  EXPECT_FLOAT_EQ(value(5, kNormal + 1), 6);
  EXPECT_TRUE(std::isnan(value(30, kNormal + 1)));
  EXPECT_TRUE(std::isnan(value(30, kPoints + 3 * kHeldBall)));
  EXPECT_FALSE(std::isnan(value(30, kPoints + 3 * kToolPlate)));
}

TEST_F(ATimeline, TakesTheThrowsOfAnotherRunForOthers) {
  plan_request_t request{};
  request.request_id = 1;
  request.strategy = "robust";
  request.n_WTarget[0] = -1;
  request.p_WTarget[0] = 3;
  request.target_radius = 0.1;
  take(timeline_, messaging::kPlanRequest, request);
  take(timeline_, messaging::kPlanRequest, request);
  EXPECT_EQ(timeline_.throws().size(), 1U);
  tick(1, 0);
  tick(1, 900);
  take(timeline_, messaging::kPlanRequest, request);
  ASSERT_EQ(timeline_.throws().size(), 2U);
  tick(1, 0);
  EXPECT_EQ(timeline_.throws().size(), 2U);
  EXPECT_GT(timeline_.throws().back().t_scene, timeline_.throws().front().t_scene);
}

TEST_F(ATimeline, NeverHearsTheTruth) {
  EXPECT_FALSE(std::regex_match("SIM_TRUTH", std::regex(timeline_.channels())));
  EXPECT_TRUE(std::regex_match("CAMERA_LEFT", std::regex(timeline_.channels())));
  tick(1, 0);
  sim_truth_t truth{};
  truth.scene_id = 9;
  take(timeline_, messaging::kSimTruth, truth);
  EXPECT_EQ(timeline_.throws().size(), 1U);
  EXPECT_EQ(timeline_.counts().count("SIM_TRUTH"), 0U);
}

TEST_F(ATimeline, CountsWhatDoesNotDecodeOrBreaksItsRule) {
  auto state = armState(1, 0);
  state.q[0] = std::nan("");
  take(timeline_, messaging::kArmState, state);
  timeline_.take("ARM_STATE", "rubbish", 7, kWallUs);
  timeline_.take("CAMERA_LEFT", "rubbish", 7, kWallUs);
  EXPECT_EQ(timeline_.counts().at("ARM_STATE").invalid, 2);
  EXPECT_EQ(timeline_.counts().at("CAMERA_LEFT").invalid, 1);
  EXPECT_TRUE(timeline_.samples().empty());
  EXPECT_THAT(missingFromNetwork(timeline_), Contains(HasSubstr("2 of ARM_STATE")));
}

nlohmann::json headerOf(const std::string& frame) {
  uint32_t length = 0;
  std::memcpy(&length, frame.data(), sizeof(length));
  return nlohmann::json::parse(frame.substr(sizeof(length), length));
}

TEST_F(ATimeline, TellsEachSampleOnce) {
  Cursor cursor;
  for (int i = 0; i < 11; ++i)
    tick(1, i);
  const std::string first = nextFrame(timeline_, cursor, nullptr, kWallUs);
  EXPECT_EQ(headerOf(first).at("samples"), 10);
  uint32_t length = 0;
  std::memcpy(&length, first.data(), sizeof(length));
  EXPECT_EQ((sizeof(length) + length) % 8, 0U);
  EXPECT_EQ(first.size(),
            sizeof(length) + length + 10 * (sizeof(double) + kSampleValues * sizeof(float)));
  EXPECT_EQ(nextFrame(timeline_, cursor, nullptr, kWallUs), "");
  tick(1, 11);
  tick(1, 12);
  EXPECT_EQ(headerOf(nextFrame(timeline_, cursor, nullptr, kWallUs)).at("samples"), 2);
}

TEST_F(ATimeline, SurvivesNotesThatAreNoText) {
  tick(1, 0);
  estop_t estop{};
  estop.reason = "stop\xff\xfe";
  take(timeline_, messaging::kEstop, estop);
  Cursor cursor;
  const auto header = headerOf(nextFrame(timeline_, cursor, nullptr, kWallUs));
  EXPECT_THAT(header.at("throws").at(0).at("note").get<std::string>(), HasSubstr("stop: stop"));
}

TEST(AFrame, SaysHowMuchAViewerWasTooSlowFor) {
  TimelineLimits limits;
  limits.samples = 20;
  Timeline timeline(defaultExperiment(), kFloor, limits);
  Cursor cursor;
  for (int i = 0; i <= 10; ++i)
    take(timeline, messaging::kArmState, armState(1, i));
  EXPECT_EQ(headerOf(nextFrame(timeline, cursor, nullptr, kWallUs)).at("samples"), 10);
  for (int i = 11; i <= 60; ++i)
    take(timeline, messaging::kArmState, armState(1, i));
  const auto header = headerOf(nextFrame(timeline, cursor, nullptr, kWallUs));
  EXPECT_EQ(header.at("samples"), 20);
  EXPECT_EQ(header.at("skipped"), 30);
}

TEST(AViewedLog, SaysWhichChannelsAreMissing) {
  WrittenLog file;
  for (int i = 0; i < 10; ++i)
    file.add(messaging::kArmState, armState(1, i));
  file.close();
  const ViewedLog log(file.path, defaultExperiment(), kFloor);
  EXPECT_EQ(log.timeline().samples().end(), 9);
  EXPECT_THAT(log.faults(), IsEmpty());
  const auto missing = missingFromLog(log.timeline());
  EXPECT_THAT(missing, Contains(HasSubstr("no HAND_STATE")));
  EXPECT_THAT(missing, Contains(HasSubstr("no images")));
  EXPECT_THAT(missing, Not(Contains(HasSubstr("no ARM_STATE"))));
}

TEST(AViewedLog, ThatIsCutShowsWhatIsThereAndSaysWhereItEnds) {
  WrittenLog file;
  for (int i = 0; i <= 500; ++i)
    file.add(messaging::kArmState, armState(1, i));
  file.close();
  std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) - 30);
  const ViewedLog log(file.path, defaultExperiment(), kFloor);
  EXPECT_EQ(log.timeline().samples().end(), 499);
  ASSERT_EQ(log.faults().size(), 1U);
  EXPECT_EQ(log.faults()[0], "The log is cut at 0.50 s, in the middle of a message.");
}

TEST(AViewedLog, ThatIsDamagedInTheMiddleGoesOnBehindIt) {
  WrittenLog file;
  for (int i = 0; i <= 500; ++i)
    file.add(messaging::kArmState, armState(1, i));
  file.close();
  {
    std::fstream bytes(file.path, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file.path) / 2));
    bytes << std::string(1000, 'x');
  }
  const ViewedLog log(file.path, defaultExperiment(), kFloor);
  EXPECT_GT(log.timeline().samples().end(), 480);
  EXPECT_THAT(log.faults(), Contains(HasSubstr("damaged in 1 place, the first at 0.2")));
}

TEST(AViewedLog, HandsOutItsImagesFromTheFile) {
  WrittenLog file;
  image_t image{};
  image.width = image.height = image.row_stride = 2;
  image.pixelformat = image_t::MJPEG;
  for (int i = 0; i < 5; ++i) {
    image.size = i + 1;
    image.data.assign(static_cast<std::size_t>(image.size), static_cast<uint8_t>(i));
    file.add(messaging::kCameraLeft, image);
    file.add(messaging::kArmState, armState(1, i));
  }
  file.close();
  ViewedLog log(file.path, defaultExperiment(), kFloor);
  const auto& pictures = log.timeline().pictures().at("CAMERA_LEFT");
  ASSERT_EQ(pictures.end(), 5);
  for (const int64_t i : {3, 0, 4})
    EXPECT_EQ(log.image(*pictures.at(i))->data.size(), static_cast<std::size_t>(i + 1));
}

TEST(AViewedLog, WithoutAnyMessageIsRefused) {
  const std::string path = testing::TempDir() + "empty_view_test.lcmlog";
  std::ofstream(path) << "this is no log";
  EXPECT_THROW(ViewedLog(path, defaultExperiment(), kFloor), std::invalid_argument);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace fastball::view
