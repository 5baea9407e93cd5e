// The tracker as a real process over LCM, with this test as its cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "messaging/lcm_endpoint.h"
#include "tests/messaging/child_process.h"
#include "tests/vision_tracker/messages.h"

namespace fastball::vision_tracker {
namespace {

using ::testing::HasSubstr;

class TrackerProcess : public ::testing::Test {
 protected:
  TrackerProcess() {
    peer_.subscribe<landing_t>(messaging::kLanding,
                               [this](const landing_t& m) { landings_.push_back(m); });
    peer_.subscribe<ball_observation_t>(messaging::kBallObservation,
                                        [this](const ball_observation_t&) { ++observed_; });
    peer_.subscribe<heartbeat_t>(messaging::kHeartbeat,
                                 [this](const heartbeat_t& m) { heartbeat_ = m; });
  }

  /// Says a message every 20 ms until `done()`. @return false after 20 s.
  template <class Say, class Done>
  bool sayUntil(Say say, Done done) {
    for (int i = 0; i < 1000; ++i) {
      say();
      for (int wait = 0; wait < 20; ++wait) {
        peer_.drain();
        if (done())
          return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    return false;
  }

  bool prepared(int64_t id) {
    return sayUntil(
        [&] {
          peer_.publish(messaging::kPlanRequest, testing::requestMessage(experiment_, id));
          for (const sim_bullet::RigCamera& camera : rig_.cameras())
            peer_.publish(messaging::kCameraInfo, testing::infoMessage(camera));
        },
        [&] { return heartbeat_.plan_id == id && heartbeat_.state == "waiting"; });
  }

  /// All images; goes no faster than the process, so that nothing depends on its speed.
  bool show(const std::vector<sim_bullet::RenderedImage>& images) {
    int said = 0;
    for (const sim_bullet::RenderedImage& image : images) {
      peer_.publish(image.camera == 0 ? messaging::kCameraLeft : messaging::kCameraRight,
                    testing::imageMessage(image));
      ++said;
      if (!sayUntil([] {}, [&] { return said - observed_ < 10; }))
        return false;
    }
    return sayUntil([] {}, [&] { return !landings_.empty(); });
  }

  static sim_bullet::CameraRigOptions rigOptions() {
    sim_bullet::CameraRigOptions options = sim_bullet::readCameraRig(testing::experimentPath());
    options.workers = 2;
    return options;
  }

  config::Experiment experiment_ = config::loadExperiment(testing::experimentPath());
  sim_bullet::CameraRig rig_{rigOptions(), experiment_.arm, experiment_.hand,
                             experiment_.ball.radius};
  messaging::LcmEndpoint peer_{messaging::defaultLcmUrl()};
  messaging::ChildProcess process_{
      {FASTBALL_BIN_DIR "/fastball-vision-tracker", "--config", testing::experimentPath()}};
  std::vector<landing_t> landings_;
  int observed_ = 0;
  heartbeat_t heartbeat_{};
};

TEST_F(TrackerProcess, MeasuresAThrowAndTheSameAgain) {
  const bench::SyntheticThrow synthetic = bench::makeThrow(experiment_, 2);
  const auto images = bench::renderThrow(rig_, experiment_, synthetic, 2);
  std::vector<landing_t> results;
  for (int64_t id = 1; id <= 2; ++id) {
    ASSERT_TRUE(prepared(id));
    observed_ = 0;
    landings_.clear();
    ASSERT_TRUE(show(images));
    ASSERT_EQ(landings_.size(), 1u);
    ASSERT_EQ(landings_[0].measured, 1) << landings_[0].message;
    results.push_back(landings_[0]);
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(results[0].landing[i], synthetic.landing.landing[i], 3e-3);
    EXPECT_EQ(results[0].landing[i], results[1].landing[i]);
  }
  EXPECT_EQ(results[0].residual_px, results[1].residual_px);
  EXPECT_EQ(process_.stop(SIGINT), 0);
}

TEST_F(TrackerProcess, OutlivesHostileBytes) {
  ASSERT_TRUE(prepared(1));
  std::mt19937 random(5);
  std::vector<uint8_t> bytes;
  for (int i = 0; i < 200; ++i) {
    bytes.resize(random() % 3000);
    for (uint8_t& byte : bytes)
      byte = static_cast<uint8_t>(random());
    for (const char* channel : {"CAMERA_LEFT", "CAMERA_RIGHT", "CAMERA_INFO", "PLAN_REQUEST"})
      peer_.publishBytes(channel, bytes.data(), bytes.size());
  }
  // Well-formed messages whose JPEG is noise.
  for (int i = 0; i < 20; ++i) {
    sim_bullet::RenderedImage image;
    image.camera = i % 2;
    image.frame = i / 2;
    image.utime = 1000 + i / 2 * 4167;
    image.width = 640;
    image.height = 480;
    image.jpeg = {0xFF, 0xD8};
    for (int k = 0; k < 500; ++k)
      image.jpeg.push_back(static_cast<uint8_t>(random()));
    image.jpeg.insert(image.jpeg.end(), {0xFF, 0xD9});
    peer_.publish(image.camera == 0 ? messaging::kCameraLeft : messaging::kCameraRight,
                  testing::imageMessage(image));
  }
  ASSERT_TRUE(prepared(2));
  EXPECT_EQ(process_.stop(SIGTERM), 0);
}

TEST_F(TrackerProcess, RefusesABadConfiguration) {
  messaging::ChildProcess bad(
      {FASTBALL_BIN_DIR "/fastball-vision-tracker", "--config", "/nowhere.yaml"});
  EXPECT_EQ(bad.wait(), 2);
  EXPECT_THAT(bad.output(), HasSubstr("/nowhere.yaml"));
}

}  // namespace
}  // namespace fastball::vision_tracker
