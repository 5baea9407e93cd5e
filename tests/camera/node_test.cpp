// The camera's node with a fake source, on a clock moved by hand.
#include "camera/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "messaging/image_channel.h"
#include "messaging/local_network.h"
#include "tests/camera/fake_source.h"

namespace fastball::camera {
namespace {

using testing::FakeSource;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using testing::waitFor;

constexpr int kImages = 15;  // fewer than wait for a process that is late

class CameraNodeTest : public ::testing::Test {
 protected:
  CameraNodeTest() {
    peer_.subscribe<image_t>(messaging::imageChannel("CAMERA_TOP"),
                             [this](const image_t& m) { images_.push_back(m); });
    peer_.subscribe<camera_info_t>(messaging::kCameraInfo, [this](const camera_info_t& m) {
      infos_.push_back(m);
      if (images_.empty())
        info_came_first_ = true;
    });
    options_.source = "the source";
    options_.channel = "CAMERA_TOP";
    clock_.advanceUs(50'000'000);
    fake_.images = testing::greyImages(kImages);
  }
  ~CameraNodeTest() override { *fake_.released = true; }

  void start() {
    node_ = makeNode(endpoint_, clock_, options_, fake_.opener());
    network_.addNode(*node_, endpoint_);
  }
  /// Steps until `done()`, at one time of the clock.
  template <class Done>
  bool stepUntil(Done done) {
    return waitFor([&] {
      network_.run([] { return false; });
      return done();
    });
  }
  /// Lets time go on in milliseconds until `done()`; before each the reading thread may catch up.
  template <class Done>
  bool playUntil(Done done, int64_t step_us = 1000) {
    return waitFor([&] {
      network_.run([] { return false; });
      clock_.advanceUs(step_us);
      return done();
    });
  }
  std::string failure() {
    try {
      playUntil([] { return false; }, 20'000);
    } catch (const std::exception& error) {
      peer_.drain();
      return error.what();
    }
    return "no failure";
  }
  static model::Camera calibration(int width, int height) {
    model::Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 70;
    camera.p_CW = {1, 2, 3};
    return camera;
  }
  void request(int64_t id) {
    plan_request_t m{};
    m.request_id = id;
    m.strategy = "paper";
    m.n_WTarget[0] = -1;
    m.target_radius = 0.1;
    ASSERT_TRUE(peer_.publish(messaging::kPlanRequest, m));
  }

  FakeSource fake_;
  CameraOptions options_;
  messaging::ManualClock clock_;
  messaging::LocalNetwork network_{clock_};
  messaging::Endpoint& peer_ = network_.addEndpoint();
  messaging::Endpoint& endpoint_ = network_.addEndpoint();
  std::unique_ptr<messaging::Node> node_;
  std::vector<image_t> images_;
  std::vector<camera_info_t> infos_;
  bool info_came_first_ = false;
};

TEST_F(CameraNodeTest, SaysAVideoAtItsPaceWithItsOwnTimes) {
  options_.video = true;
  options_.start_utime = 51'000'000;  // a second ahead
  options_.calibration = calibration(64, 48);
  options_.exposure = 0.002;
  start();
  EXPECT_EQ(node_->name(), "camera_top");
  ASSERT_TRUE(stepUntil([&] { return !infos_.empty(); }));
  EXPECT_EQ(node_->state().state, "waiting");
  clock_.advanceUs(999'999);
  network_.run([] { return false; });
  EXPECT_THAT(images_, SizeIs(0));
  clock_.advanceUs(1);
  network_.run([] { return false; });
  EXPECT_THAT(images_, SizeIs(1));
  EXPECT_EQ(node_->state().state, "publishing");
  ASSERT_TRUE(playUntil([&] { return node_->finished(); }));
  EXPECT_EQ(node_->state().state, "ended");
  ASSERT_THAT(images_, SizeIs(kImages));
  for (int k = 0; k < kImages; ++k) {
    const image_t& m = images_[static_cast<std::size_t>(k)];
    EXPECT_EQ(m.utime, 51'000'000 + 10'000 * k);
    EXPECT_EQ(m.seq, k);
    EXPECT_EQ(m.pixelformat, image_t::MJPEG);
    const cv::Mat decoded = cv::imdecode(m.data, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(decoded.size(), cv::Size(64, 48));
    EXPECT_NEAR(decoded.at<uint8_t>(10, 10), k, 2);
  }
  EXPECT_TRUE(info_came_first_);
  EXPECT_EQ(infos_[0].channel, "CAMERA_TOP");
  EXPECT_EQ(infos_[0].width, 64);
  EXPECT_EQ(infos_[0].K[0], 70);
  EXPECT_EQ(infos_[0].p_CW[2], 3);
  EXPECT_EQ(infos_[0].rate, 100);
  EXPECT_EQ(infos_[0].exposure, 0.002);
  EXPECT_EQ(endpoint_.unsent(), 0);
}

TEST_F(CameraNodeTest, SpeedChangesThePaceAndNotTheTimes) {
  options_.video = true;
  options_.speed = 0.5;
  start();
  ASSERT_TRUE(stepUntil([&] { return images_.size() == 1; }));
  const int64_t begin = clock_.monotonicUs();
  EXPECT_EQ(images_[0].utime, begin) << "the wall clock's time, where none is named";
  clock_.advanceUs(19'999);
  network_.run([] { return false; });
  EXPECT_THAT(images_, SizeIs(1));
  clock_.advanceUs(1);
  ASSERT_TRUE(stepUntil([&] { return images_.size() == 2; }));
  EXPECT_EQ(images_[1].utime, begin + 10'000);
}

TEST_F(CameraNodeTest, SaysItsCalibrationOnceASecond) {
  options_.calibration = calibration(64, 48);
  fake_.then = FakeSource::Then::kHang;
  start();
  ASSERT_TRUE(stepUntil([&] { return images_.size() == kImages; }));
  EXPECT_THAT(infos_, SizeIs(1));
  for (std::size_t seconds = 1; seconds <= 3; ++seconds) {
    clock_.advanceUs(999'999);
    network_.run([] { return false; });
    EXPECT_THAT(infos_, SizeIs(seconds));
    clock_.advanceUs(1);
    network_.run([] { return false; });
    EXPECT_THAT(infos_, SizeIs(seconds + 1));
  }
}

TEST_F(CameraNodeTest, SaysAVideoForEachNewRequest) {
  options_.video = true;
  options_.on_request = true;
  options_.calibration = calibration(64, 48);
  start();
  ASSERT_TRUE(stepUntil([&] { return !infos_.empty(); }));
  EXPECT_EQ(node_->state().state, "waiting");
  for (int64_t id = 1; id <= 2; ++id) {
    images_.clear();
    for (int again = 0; again < 3; ++again)
      request(id);
    ASSERT_TRUE(playUntil([&] { return images_.size() == kImages; }));
    EXPECT_EQ(images_.front().utime, 0);
    EXPECT_EQ(images_.back().utime, 10'000 * (kImages - 1));
    EXPECT_EQ(node_->state().plan_id, id);
    ASSERT_TRUE(playUntil([&] { return node_->state().state == "waiting"; }));
    EXPECT_FALSE(node_->finished());
    request(id);
    clock_.advanceUs(1'000'000);
    network_.run([] { return false; });
    EXPECT_THAT(images_, SizeIs(kImages));
  }
}

TEST_F(CameraNodeTest, SaysADevicesImagesAsTheyComeWithItsTimes) {
  for (std::size_t k = 0; k < 10; ++k)
    fake_.images[k].utime = 1000 + 7 * static_cast<int64_t>(k);
  fake_.images.resize(10);
  fake_.then = FakeSource::Then::kFail;
  start();
  EXPECT_EQ(failure(), "the plug was pulled");
  ASSERT_THAT(images_, SizeIs(10));
  EXPECT_EQ(images_[9].utime, 1063);
  EXPECT_THAT(infos_, SizeIs(0)) << "without a calibration";
}

TEST_F(CameraNodeTest, FailsWhenADeviceCannotBeOpened) {
  fake_.open_failure = "it is busy";
  start();
  EXPECT_EQ(failure(), "it is busy");
}

TEST_F(CameraNodeTest, FailsWhenADevicesImagesStop) {
  fake_.then = FakeSource::Then::kHang;
  start();
  EXPECT_EQ(failure(), "the source: no image for 5 s");
  EXPECT_THAT(images_, SizeIs(kImages));
}

TEST_F(CameraNodeTest, RefusesImagesOfAnotherSizeThanWanted) {
  options_.size = {640, 480};
  start();
  EXPECT_EQ(failure(), "the source: its images have 64 x 48 pixels, --size says 640 x 480");
}

TEST_F(CameraNodeTest, RefusesTheCalibrationOfAnotherCamera) {
  options_.calibration = calibration(640, 480);
  start();
  EXPECT_THAT(failure(),
              HasSubstr("64 x 48 pixels, but the calibration is of a camera with 640 x 480"));
}

TEST_F(CameraNodeTest, FailsWhenTheSizeChanges) {
  fake_.images[10].pixels = cv::Mat(24, 32, CV_8U, cv::Scalar(0));
  start();
  EXPECT_EQ(failure(), "the source: image 10 has 32 x 24 pixels, the first had 64 x 48");
}

TEST_F(CameraNodeTest, RefusesPixelsThatAreNoBytes) {
  fake_.images.resize(1);
  fake_.images[0].pixels = cv::Mat(48, 64, CV_16U, cv::Scalar(0));
  start();
  EXPECT_THAT(failure(), HasSubstr("its images have 1 channels of 2 bytes"));
}

TEST_F(CameraNodeTest, WantsARateWhereTheSourceTellsNone) {
  fake_.rate = 0;
  options_.video = true;
  start();
  EXPECT_EQ(failure(), "the source: does not tell its rate: give --rate");
}

TEST_F(CameraNodeTest, RefusesAVideoWithoutImages) {
  fake_.images.clear();
  options_.video = true;
  start();
  EXPECT_EQ(failure(), "the source: holds no image");
}

TEST_F(CameraNodeTest, SaysGreyImagesAndThatItLoweredTheQuality) {
  fake_.images = testing::greyImages(2, {320, 240}, CV_8UC3);
  for (SourceImage& image : fake_.images)
    cv::RNG(5).fill(image.pixels, cv::RNG::UNIFORM, 0, 256);
  options_.video = true;
  options_.gray = true;
  options_.quality = 100;
  start();
  ASSERT_TRUE(playUntil([&] { return images_.size() == 2; }));
  EXPECT_EQ(cv::imdecode(images_[0].data, cv::IMREAD_UNCHANGED).channels(), 1);
  EXPECT_LE(images_[0].size, 60000);
  EXPECT_THAT(node_->state().detail, HasSubstr("JPEG quality is"));
}

}  // namespace
}  // namespace fastball::camera
