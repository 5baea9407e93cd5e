// The tracker's node among scripted cameras, in one process.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/vision_tracker/tracker_node_fixture.h"

namespace fastball::vision_tracker {
namespace {

using sim_bullet::RenderedImage;

TEST_F(TrackerNodeTest, MeasuresAThrow) {
  EXPECT_EQ(node_->state().state, "idle");
  request(7);
  calibrate();
  run();
  EXPECT_EQ(node_->state().state, "waiting");
  EXPECT_EQ(node_->state().plan_id, 7);
  const std::vector<RenderedImage> images = drawn(1);
  bool tracked = false;
  for (const RenderedImage& image : images) {
    show(image);
    run();
    tracked = tracked || node_->state().state == "tracking";
  }
  EXPECT_TRUE(tracked);
  EXPECT_EQ(node_->state().state, "landed");
  EXPECT_EQ(observations_.size(), images.size());
  ASSERT_EQ(landings_.size(), 1u);
  const landing_t& landing = landings_.front();
  EXPECT_EQ(landing.request_id, 7);
  ASSERT_EQ(landing.measured, 1) << landing.message;
  EXPECT_EQ(landing.message, "");
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(landing.landing[i], synthetic_.landing.landing[i], 3e-3);
  EXPECT_GT(landing.cov_landing[0], 0);
  EXPECT_NEAR(landing.v_WBall[0], synthetic_.landing.state.v_WBall.x(), 0.02);
  ASSERT_GT(tracks_.size(), 50u);
  EXPECT_NEAR(tracks_.back().landing[0], landing.landing[0], 1e-3);
  EXPECT_EQ(endpoint_.unsent(), 0);
}

TEST_F(TrackerNodeTest, SaysTheSameHoweverTheCamerasAreWoven) {
  const std::vector<RenderedImage> images = drawn(2);
  std::vector<std::vector<uint8_t>> said;
  for (int64_t id = 1; id <= 2; ++id) {
    landings_.clear();
    observations_.clear();
    request(id);
    calibrate();
    run();
    std::vector<RenderedImage> order = images;
    if (id == 2)  // the right camera ahead of the left one, by 15 images
      std::stable_sort(
          order.begin(), order.end(), [](const RenderedImage& a, const RenderedImage& b) {
            return a.frame + (a.camera == 0 ? 15 : 0) < b.frame + (b.camera == 0 ? 15 : 0);
          });
    for (const RenderedImage& image : order)
      show(image);
    run();
    ASSERT_EQ(landings_.size(), 1u);
    landings_[0].seq = landings_[0].request_id = 0;
    std::vector<uint8_t> bytes(static_cast<std::size_t>(landings_[0].getEncodedSize()));
    landings_[0].encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    for (ball_observation_t& o : observations_) {
      o.seq = o.request_id = 0;
      std::vector<uint8_t> more(static_cast<std::size_t>(o.getEncodedSize()));
      o.encode(more.data(), 0, static_cast<int>(more.size()));
      if (o.utime < landings_[0].utime)
        bytes.insert(bytes.end(), more.begin(), more.end());
    }
    said.push_back(bytes);
  }
  EXPECT_EQ(said[0], said[1]);
}

TEST_F(TrackerNodeTest, DropsImagesBeforeItKnowsTheCamerasAndTheTarget) {
  const std::vector<RenderedImage> images = drawn(1);
  show(images[0]);
  run();
  EXPECT_EQ(node_->state().detail, "CAMERA_LEFT: image 0 came before a PLAN_REQUEST");
  request(1);
  show(images[1]);
  run();
  EXPECT_EQ(node_->state().detail,
            "CAMERA_RIGHT: image 0 came before CAMERA_INFO of CAMERA_LEFT and CAMERA_RIGHT");
  EXPECT_TRUE(observations_.empty());
}

TEST_F(TrackerNodeTest, BearsBadImagesAndCountsThem) {
  request(1);
  calibrate();
  std::vector<RenderedImage> images = drawn(3);
  int bad = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (i % 40 == 11) {  // cut off
      images[i].jpeg.resize(100);
      ++bad;
    } else if (i % 40 == 22) {  // said twice, which is none
      show(images[i]);
    } else if (i % 40 == 33) {  // from the past
      show(images[i - 6]);
      ++bad;
    } else if (i % 40 == 37) {  // another size
      images[i].width = 320;
      ++bad;
    }
    show(images[i]);
  }
  run();
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_EQ(landings_[0].measured, 1) << landings_[0].message;
  EXPECT_NEAR(landings_[0].landing[0], synthetic_.landing.landing[0], 3e-3);
  EXPECT_NE(landings_[0].message.find(" images could not be used, the first: CAMERA_"),
            std::string::npos)
      << landings_[0].message;
  EXPECT_GT(bad, 20);  // some after the landing, which are not decoded any more
}

TEST_F(TrackerNodeTest, RefusesACalibrationThatIsNone) {
  request(1);
  camera_info_t info = testing::infoMessage(rig_->cameras()[0]);
  info.R_CW[0] = 0.5;
  experimenter_.publish(messaging::kCameraInfo, info);
  run();
  EXPECT_NE(node_->state().detail.find("CAMERA_INFO of CAMERA_LEFT is no calibration"),
            std::string::npos);
}

TEST_F(TrackerNodeTest, GivesUpWhenTheImagesEnd) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  for (std::size_t i = 0; i < 20; ++i)
    show(images[i]);
  run();
  EXPECT_TRUE(landings_.empty());
  clock_.advanceUs(node_->wakeUs() - clock_.monotonicUs());
  run();
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_EQ(landings_[0].measured, 0);
  EXPECT_EQ(landings_[0].message,
            "not measured: nothing that flies like the ball is in the 20 images");
  EXPECT_EQ(landings_[0].landing[0], 0);
  EXPECT_EQ(node_->state().state, "landed");
  EXPECT_EQ(node_->wakeUs(), INT64_MAX);
}

TEST_F(TrackerNodeTest, BeginsAnewForANewRequestOnly) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  for (const RenderedImage& image : images)
    show(image);
  run();
  request(1);
  run();
  EXPECT_EQ(node_->state().state, "landed");
  request(2);
  run();
  EXPECT_EQ(node_->state().state, "waiting");
  for (const RenderedImage& image : images)
    show(image);
  run();
  ASSERT_EQ(landings_.size(), 2u);
  EXPECT_EQ(landings_[1].request_id, 2);
  EXPECT_EQ(landings_[0].landing[0], landings_[1].landing[0]);
}

TEST_F(TrackerNodeTest, AnswersAnImageThatIsSaidAgain) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  for (std::size_t i = 0; i < 20; ++i)
    show(images[i]);
  run();
  const std::size_t answers = observations_.size();
  show(images[19]);
  show(images[17]);  // of the same camera, but older: nobody waits for its answer
  run();
  ASSERT_EQ(observations_.size(), answers + 1);
  EXPECT_EQ(observations_.back().utime, images[19].utime);
  EXPECT_EQ(observations_.back().channel, images[19].camera == 0 ? "CAMERA_LEFT" : "CAMERA_RIGHT");
}

TEST_F(TrackerNodeTest, SaysItsLandingAgainToASceneThatIsSaidAgain) {
  request(1);
  calibrate();
  scene_t scene{};
  scene.scene_id = 1;
  scene.duration = 1;
  scene.target_radius = 0.1;
  scene.n_WTarget[0] = -1;
  experimenter_.publish(messaging::kScene, scene);
  for (const RenderedImage& image : drawn(1))
    show(image);
  run();
  ASSERT_EQ(landings_.size(), 1u);
  experimenter_.publish(messaging::kScene, scene);
  scene.scene_id = 2;  // the next: it is measured when it has been thrown
  experimenter_.publish(messaging::kScene, scene);
  run();
  ASSERT_EQ(landings_.size(), 2u);
  EXPECT_EQ(landings_[1].request_id, 1);
  EXPECT_EQ(landings_[1].landing[0], landings_[0].landing[0]);
}

TEST_F(TrackerNodeTest, DoesNotListenToTheTruth) {
  for (const auto& [channel, counts] : endpoint_.counts())
    EXPECT_NE(channel, "SIM_TRUTH");
  EXPECT_EQ(endpoint_.counts().size(), 5u);
}

}  // namespace
}  // namespace fastball::vision_tracker
