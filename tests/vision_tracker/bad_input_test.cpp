// What a tracker must bear: each kind of bad input is counted, said once, and never ends in a wrong landing said with
// confidence.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <functional>

#include "messaging/image_channel.h"
#include "tests/vision_tracker/changed_experiment.h"
#include "tests/vision_tracker/tracker_node_fixture.h"

namespace fastball::vision_tracker {
namespace {

using sim_bullet::RenderedImage;
using ::testing::Each;
using ::testing::HasSubstr;

class BadInput : public TrackerNodeTest {
 protected:
  explicit BadInput(const std::string& config = testing::experimentPath())
      : TrackerNodeTest(config) {}
  void say(const camera_info_t& info) { experimenter_.publish(messaging::kCameraInfo, info); }
  camera_info_t info(std::size_t camera) const {
    return testing::infoMessage(rig_->cameras()[camera]);
  }
  void silence() {
    clock_.advanceUs(std::min<int64_t>(node_->wakeUs() - clock_.monotonicUs(), 3'600'000'000));
    run();
  }
  /// The only LANDING, which must not have come before the images end, is not measured.
  std::string whyNotMeasured() {
    silence();
    if (landings_.size() != 1 || landings_[0].measured != 0)
      return "there are " + std::to_string(landings_.size()) + " landings, or one is measured";
    EXPECT_THAT(landings_[0].landing, Each(0.0));
    EXPECT_THAT(landings_[0].cov_landing, Each(0.0));
    return landings_[0].message;
  }
  /// The landing's error in its own standard deviations, chi-square distributed with two degrees of freedom if it is honest.
  double normalisedErrorSquared(const landing_t& m) const {
    const Eigen::Vector2d error =
        Eigen::Map<const Eigen::Vector2d>(m.landing) - synthetic_.landing.landing;
    Eigen::Matrix2d cov;
    cov << m.cov_landing[0], m.cov_landing[1], m.cov_landing[1], m.cov_landing[2];
    return error.dot(cov.inverse() * error);
  }
  void expectNoConfidentError() {
    silence();
    ASSERT_EQ(landings_.size(), 1u);
    if (landings_[0].measured == 0)
      return;
    EXPECT_LT(normalisedErrorSquared(landings_[0]), 14)  // one in a thousand
        << landings_[0].landing[0] << ", " << landings_[0].landing[1] << " m, true "
        << synthetic_.landing.landing.transpose();
  }
};

class SwappedCalibration : public BadInput, public ::testing::WithParamInterface<int> {};

TEST_P(SwappedCalibration, GivesNoConfidentError) {
  const std::vector<RenderedImage> images = drawn(GetParam());
  request(1);
  camera_info_t left = info(0), right = info(1);
  std::swap(left.channel, right.channel);
  say(left);
  say(right);
  run();
  for (const RenderedImage& image : images)
    show(image);
  run();
  expectNoConfidentError();
}

INSTANTIATE_TEST_SUITE_P(Throws, SwappedCalibration, ::testing::Values(1, 3, 4, 6));

TEST_F(BadInput, CalibrationOfALensThatIsAnotherGivesNoConfidentError) {
  const std::vector<RenderedImage> images = drawn(5);
  request(1);
  camera_info_t left = info(0);
  left.K[0] = left.K[4] = 700;  // instead of 940 px
  say(left);
  say(info(1));
  run();
  for (const RenderedImage& image : images)
    show(image);
  run();
  expectNoConfidentError();
}

TEST_F(BadInput, ACalibrationOfAnotherImageSizeIsSaid) {
  request(1);
  camera_info_t left = info(0);
  left.width = 1280;
  left.height = 960;
  say(left);
  say(info(1));
  const std::vector<RenderedImage> images = drawn(1);
  for (const RenderedImage& image : images)
    show(image);
  run();
  EXPECT_THAT(whyNotMeasured(), HasSubstr("is 640 x 480 pixels, but its camera has 1280 x 960"));
}

TEST_F(BadInput, ACalibrationThatChangesEndsTheThrow) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (i == images.size() / 3) {
      camera_info_t moved = info(1);
      moved.p_CW[0] += 0.1;
      say(moved);
    }
    show(images[i]);
  }
  run();
  EXPECT_EQ(whyNotMeasured(),
            "not measured: the calibration of CAMERA_RIGHT changed during the throw");
  EXPECT_EQ(observations_.size(), images.size());
  // The next throw has the new calibration from its beginning on; put back, it measures.
  landings_.clear();
  calibrate();
  request(2);
  for (const RenderedImage& image : images)
    show(image);
  run();
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_EQ(landings_[0].measured, 1) << landings_[0].message;
  EXPECT_NEAR(landings_[0].landing[0], synthetic_.landing.landing[0], 3e-3);
  // Too late to matter for this throw.
  camera_info_t moved = info(0);
  moved.p_CW[1] += 0.1;
  say(moved);
  run();
  EXPECT_EQ(node_->state().state, "landed");
  EXPECT_EQ(landings_.size(), 1u);
}

TEST_F(BadInput, ImagesWithOneTimeAndTimesThatGoBackwards) {
  request(1);
  calibrate();
  std::vector<RenderedImage> images = drawn(1);
  for (RenderedImage& image : images) {
    image.utime = images.front().utime;
    show(image);
  }
  run();
  EXPECT_THAT(whyNotMeasured(), HasSubstr(std::to_string(images.size() - 2) +
                                          " images could not be used, the first: CAMERA_LEFT: "
                                          "image 1 has the time of the one before"));
  landings_.clear();
  request(2);
  for (auto image = images.rbegin(); image != images.rend(); ++image) {
    image->utime = 1'000'000 + image->frame * 4167;
    show(*image);
  }
  run();
  EXPECT_THAT(whyNotMeasured(), HasSubstr("us came after a later one"));
}

TEST_F(BadInput, ATimeBeyondAllTimesIsRefused) {
  request(1);
  calibrate();
  std::vector<RenderedImage> images = drawn(2);
  for (std::size_t i = 0; i < images.size(); ++i) {
    RenderedImage image = images[i];
    if (i % 50 == 20)
      image.utime = INT64_MAX - 5;
    show(image);
  }
  run();
  silence();
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_EQ(landings_[0].measured, 1) << landings_[0].message;
  EXPECT_THAT(landings_[0].message, HasSubstr("which is no time"));
  EXPECT_NEAR(landings_[0].landing[0], synthetic_.landing.landing[0], 3e-3);
}

TEST_F(BadInput, EveryJpegCutOff) {
  request(1);
  calibrate();
  for (RenderedImage image : drawn(1)) {
    image.jpeg.resize(image.jpeg.size() / 2);
    show(image);
  }
  run();
  EXPECT_THAT(whyNotMeasured(), HasSubstr("images could not be used, the first: CAMERA_LEFT: "
                                          "image 0 is no whole JPEG image"));
}

TEST_F(BadInput, CalibrationsThatNeverComeAreSaid) {
  request(1);
  say(info(0));
  for (const RenderedImage& image : drawn(1))
    show(image);
  run();
  EXPECT_THAT(whyNotMeasured(),
              HasSubstr("CAMERA_LEFT: image 0 came before CAMERA_INFO of CAMERA_RIGHT"));
}

TEST_F(BadInput, ARequestEndsTheOneBefore) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  for (std::size_t i = 0; i < 30; ++i)
    show(images[i]);
  run();
  request(2);
  run();
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_EQ(landings_[0].request_id, 1);
  EXPECT_EQ(landings_[0].measured, 0);
  EXPECT_EQ(node_->state().state, "waiting");
}

TEST_F(BadInput, CalibrationsOfOtherCamerasAreSaidOnce) {
  request(1);
  calibrate();
  camera_info_t other = info(0);
  for (const char* channel : {"CAMERA_TOP", "CAMERA_TOP", "CAMERA_BACK"}) {
    other.channel = channel;
    say(other);
  }
  run();
  EXPECT_EQ(node_->state().detail,
            "CAMERA_INFO of CAMERA_TOP is of none of tracker.cameras, CAMERA_LEFT, CAMERA_RIGHT");
}

TEST_F(BadInput, CalibrationsThatCannotBeAreNamed) {
  const std::vector<std::pair<std::function<void(camera_info_t&)>, const char*>> faults = {
      {[](camera_info_t& m) { m.R_CW[0] = -m.R_CW[0]; }, "R_CW is no rotation"},
      {[](camera_info_t& m) { m.K[0] = -940; }, "its focal lengths are -940"},
      {[](camera_info_t& m) { m.K[1] = 3; }, "its K is not [fx 0 cx; 0 fy cy; 0 0 1]"},
      {[](camera_info_t& m) { m.K[2] = 1e9; }, "its principal point"},
      {[](camera_info_t& m) { m.D[4] = 1e30; }, "a distortion coefficient"},
      {[](camera_info_t& m) { m.p_CW[1] = -1e300; }, "from the world's origin"},
      {[](camera_info_t& m) { m.rate = 1e-300; }, "its rate is"},
      {[](camera_info_t& m) { m.exposure = 1e300; }, "its exposure"}};
  int64_t id = 0;
  for (const auto& [spoil, why] : faults) {
    request(++id);
    camera_info_t spoilt = info(0);
    spoil(spoilt);
    say(spoilt);
    run();
    EXPECT_THAT(node_->state().detail, HasSubstr(why));
  }
}

/// As cameras that are not triggered do, they show an empty scene for ever.
class NoBall : public BadInput {
 protected:
  explicit NoBall(const testing::ChangedExperiment& experiment = {"longest_wait: 60.0",
                                                                  "longest_wait: 1.0"})
      : BadInput(experiment.path()) {}
};

TEST_F(NoBall, IsSaidAfterTheLongestWait) {
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  int64_t frame = 0;
  while (landings_.empty() && frame < 400) {
    for (const std::size_t camera : {0U, 1U}) {
      RenderedImage image = images[camera];  // before the ball is thrown
      image.frame = frame;
      image.utime = 1'000'000 + frame * 4167;
      show(image);
    }
    ++frame;
    run();
  }
  EXPECT_NEAR(static_cast<double>(frame), 240, 3);
  ASSERT_EQ(landings_.size(), 1u);
  EXPECT_THAT(landings_[0].message, HasSubstr("nothing that flies like the ball"));
  EXPECT_EQ(landings_[0].measured, 0);
  EXPECT_EQ(node_->state().state, "landed");
}

class ThreeCameras : public BadInput {
 protected:
  explicit ThreeCameras(const testing::ChangedExperiment& experiment =
                            {"cameras: [CAMERA_LEFT, CAMERA_RIGHT]",
                             "cameras: [CAMERA_LEFT, CAMERA_RIGHT, CAMERA_TOP]"})
      : BadInput(experiment.path()) {}
};

TEST_F(ThreeCameras, AreAllWaitedFor) {
  EXPECT_EQ(endpoint_.counts().count("CAMERA_TOP"), 1u);
  request(1);
  calibrate();
  const std::vector<RenderedImage> images = drawn(1);
  show(images[0]);
  run();
  EXPECT_EQ(node_->state().detail, "CAMERA_LEFT: image 0 came before CAMERA_INFO of CAMERA_TOP");
  camera_info_t top = info(0);
  top.channel = "CAMERA_TOP";
  say(top);
  show(images[2]);
  experimenter_.publish(messaging::imageChannel("CAMERA_TOP"), testing::imageMessage(images[2]));
  show(images[3]);
  run();
  EXPECT_EQ(observations_.size(), 3u);
  EXPECT_EQ(observations_.back().channel, "CAMERA_TOP");
}

}  // namespace
}  // namespace fastball::vision_tracker
