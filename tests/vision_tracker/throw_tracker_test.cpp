// The tracker on drawn images of synthetic throws, whose truth is known.
#include "vision_tracker/throw_tracker.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "bench/synthetic_throw.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/config.h"
#include "vision_tracker/image_order.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

using bench::SyntheticThrow;
using sim_bullet::RenderedImage;

class TrackerOnImages : public ::testing::Test {
 protected:
  TrackerOnImages() {
    for (int i = 0; i < 2; ++i) {
      const sim_bullet::RigCamera& c = rig_.cameras()[static_cast<std::size_t>(i)];
      tracker_.setCamera(i, {c.camera, c.rate, c.exposure});
    }
  }

  static sim_bullet::CameraRigOptions rigOptions() {
    sim_bullet::CameraRigOptions options = sim_bullet::readCameraRig(testing::experimentPath());
    options.workers = 2;
    return options;
  }

  std::vector<RenderedImage> drawn(const SyntheticThrow& synthetic, int64_t seed = 1) {
    return bench::renderThrow(rig_, experiment_, synthetic, seed);
  }

  using Watch = std::function<void(const RenderedImage&, const Sighting&)>;
  /// Gives the tracker all images, as a node does.
  LandingReport track(const std::vector<RenderedImage>& images, const Watch& watch = {}) {
    tracker_.begin(experiment_.target);
    std::optional<LandingReport> landing;
    cv::Mat decoded;
    tracks_ = 0;
    for (const RenderedImage& image : images) {
      ReceivedImage received;
      received.width = image.width;
      received.height = image.height;
      received.data = image.jpeg;
      if (!decode(received, {640, 480}, decoded).empty())
        continue;
      const Sighting sighting = tracker_.add(image.camera, image.utime, decoded);
      if (watch)
        watch(image, sighting);
      tracks_ += tracker_.takeTrack() ? 1 : 0;
      if (const auto report = tracker_.takeLanding())
        landing = report;
    }
    tracker_.end();
    if (const auto report = tracker_.takeLanding()) {
      EXPECT_FALSE(landing) << "a second landing";
      landing = report;
    }
    return landing.value_or(LandingReport{});
  }

  config::Experiment experiment_ = config::loadExperiment(testing::experimentPath());
  sim_bullet::CameraRig rig_{rigOptions(), experiment_.arm, experiment_.hand,
                             experiment_.ball.radius};
  ThrowTracker tracker_{readTracker(testing::experimentPath()).tracker};
  int tracks_ = 0;
};

TEST_F(TrackerOnImages, FindsTheBallToATenthOfAPixel) {
  const SyntheticThrow synthetic = bench::makeThrow(experiment_, 3);
  int expected = 0, found = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0;
  track(drawn(synthetic), [&](const RenderedImage& image, const Sighting& sighting) {
    const double t = static_cast<double>(image.utime - synthetic.release_utime) * 1e-6;
    if (t < 0.03 || image.utime > synthetic.landing_utime)
      return;
    const model::BallState ball =
        model::fly(synthetic.release, t, synthetic.drag, experiment_.arm.gravity);
    if (experiment_.target.distance(ball.p_WBall) < 0.07)
      return;
    ++expected;
    if (!sighting.found)
      return;
    ++found;
    const Eigen::Vector2d truth =
        outlineCentre(rig_.cameras()[static_cast<std::size_t>(image.camera)].camera, ball.p_WBall,
                      experiment_.ball.radius);
    const Eigen::Vector2d error = sighting.fit.centre - truth;
    sum += error;
    squares += error.squaredNorm();
    EXPECT_LT(error.norm(), 0.2);
  });
  EXPECT_GT(expected, 150);
  EXPECT_GE(found, expected * 98 / 100);
  EXPECT_LT((sum / found).norm(), 0.05);
  EXPECT_LT(std::sqrt(squares / (2 * found)), 0.06);  // per axis
}

class TrackerOnManyThrows : public TrackerOnImages, public ::testing::WithParamInterface<int> {};

TEST_P(TrackerOnManyThrows, LandsWithinThreeMillimetresAndSaysHowWell) {
  double normalised = 0;
  for (int i = 0; i < 5; ++i) {
    const int seed = 5 * GetParam() + i + 1;
    const SyntheticThrow synthetic = bench::makeThrow(experiment_, seed);
    const LandingReport report = track(drawn(synthetic, seed));
    ASSERT_TRUE(report.measured) << report.message;
    const Eigen::Vector2d error = report.landing.landing - synthetic.landing.landing;
    EXPECT_LT(error.norm(), 3e-3) << "seed " << seed;
    EXPECT_LT(report.landing.cov.diagonal().cwiseSqrt().maxCoeff(), 1e-3) << "sigma says nothing";
    EXPECT_NEAR(static_cast<double>(report.landing.utime),
                static_cast<double>(synthetic.landing_utime), 400);
    EXPECT_LT((report.landing.state.v_WBall - synthetic.landing.state.v_WBall).norm(), 0.02);
    EXPECT_GT(tracks_, 60);
    normalised += error.dot(report.landing.cov.inverse() * error) / 5;
  }
  // Five chi-squares of two dimensions have a mean of 2; far more would mean that sigma is too small.
  EXPECT_LT(normalised, 4.0);
}

INSTANTIATE_TEST_SUITE_P(TwentySeeds, TrackerOnManyThrows, ::testing::Range(0, 4));

// A turned camera moves the ball and the net in its images alike.
TEST_F(TrackerOnImages, MeasuresAgainstTheNetWhereTheCalibrationIsWrong) {
  const SyntheticThrow synthetic = bench::makeThrow(experiment_, 3);
  TrackerOptions options = readTracker(testing::experimentPath()).tracker;
  options.prior.calibration = {0.5e-3, 1e-3, 1e-3};
  const std::vector<RenderedImage> images = drawn(synthetic);
  double errors[2] = {};
  for (const bool measured : {false, true}) {
    options.measure_target = measured;
    tracker_ = ThrowTracker(options);
    for (int i = 0; i < 2; ++i) {
      sim_bullet::RigCamera c = rig_.cameras()[static_cast<std::size_t>(i)];
      const double way = i == 0 ? 1 : -1;
      c.camera = displaced(
          c.camera, (CameraConstants() << 0, 0, 0, way * 7e-4, 0, 0, 1e-3, 0, 1e-3).finished());
      tracker_.setCamera(i, {c.camera, c.rate, c.exposure});
    }
    const LandingReport report = track(images);
    ASSERT_TRUE(report.measured) << report.message;
    EXPECT_EQ(report.message, "");
    errors[measured] = (report.landing.landing - synthetic.landing.landing).norm();
  }
  EXPECT_GT(errors[false], 8e-3);
  EXPECT_LT(errors[true], 2e-3);
}

TEST_F(TrackerOnImages, TakesTheTargetAsGivenWhereItSeesNone) {
  TrackerOptions options = readTracker(testing::experimentPath()).tracker;
  options.measure_target = true;
  const double position = options.ring.position;
  tracker_ = ThrowTracker(options);
  for (int i = 0; i < 2; ++i) {
    const sim_bullet::RigCamera& c = rig_.cameras()[static_cast<std::size_t>(i)];
    tracker_.setCamera(i, {c.camera, c.rate, c.exposure});
  }
  const std::vector<RenderedImage> images = drawn(bench::makeThrow(experiment_, 3));
  experiment_.target.p_WTarget.x() -= 0.4;  // there the cameras see the wall
  const LandingReport report = track(images);
  ASSERT_TRUE(report.measured) << report.message;
  EXPECT_NE(report.message.find("taken as given"), std::string::npos) << report.message;
  EXPECT_GT(std::sqrt(report.landing.cov(0, 0)), 0.9 * position);
}

TEST_F(TrackerOnImages, SaysTheSameBitForBitAgain) {
  const std::vector<RenderedImage> images = drawn(bench::makeThrow(experiment_, 2));
  const LandingReport first = track(images);
  track(drawn(bench::makeThrow(experiment_, 4)));
  const LandingReport again = track(images);
  ASSERT_TRUE(first.measured);
  EXPECT_EQ(first.landing.landing, again.landing.landing);
  EXPECT_EQ(first.landing.cov, again.landing.cov);
  EXPECT_EQ(first.landing.utime, again.landing.utime);
}

TEST_F(TrackerOnImages, BearsLostAndBrokenImages) {
  const SyntheticThrow synthetic = bench::makeThrow(experiment_, 6);
  std::vector<RenderedImage> images;
  int i = 0;
  for (RenderedImage& image : drawn(synthetic)) {
    ++i;
    if (i % 9 == 0 || (i > 150 && i < 170))
      continue;  // lost, one by one and in a row
    if (i % 13 == 0)
      image.jpeg.resize(image.jpeg.size() / 2);
    images.push_back(image);
  }
  const LandingReport report = track(images);
  ASSERT_TRUE(report.measured) << report.message;
  EXPECT_LT((report.landing.landing - synthetic.landing.landing).norm(), 3e-3);
}

TEST_F(TrackerOnImages, BearsBallsThatFlashUpInOneCamera) {
  const SyntheticThrow synthetic = bench::makeThrow(experiment_, 7);
  std::vector<RenderedImage> images = drawn(synthetic);
  for (std::size_t i = 30; i < images.size(); i += 7) {
    cv::Mat picture = cv::imdecode(images[i].jpeg, cv::IMREAD_GRAYSCALE);
    const int u = 60 + static_cast<int>(i * 53 % 500), v = 50 + static_cast<int>(i * 31 % 380);
    cv::Mat1b spot = picture(cv::Rect(u - 9, v - 9, 19, 19));
    for (int y = 0; y < 19; ++y)
      for (int x = 0; x < 19; ++x)
        if ((x - 9) * (x - 9) + (y - 9) * (y - 9) <= 64)
          spot(y, x) = 180;
    cv::imencode(".jpg", picture, images[i].jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  }
  const LandingReport report = track(images);
  ASSERT_TRUE(report.measured) << report.message;
  EXPECT_LT((report.landing.landing - synthetic.landing.landing).norm(), 3e-3);
}

TEST_F(TrackerOnImages, SaysSoIfNothingFlies) {
  SyntheticThrow still = bench::makeThrow(experiment_, 1);
  for (sim_bullet::SceneSnapshot& s : still.snapshots)
    s.p_WBall = {0, 0, -50};
  still.snapshots.resize(300);
  still.end_utime = still.snapshots.back().utime;
  const LandingReport report = track(drawn(still));
  EXPECT_FALSE(report.measured);
  EXPECT_NE(report.message.find("nothing that flies like the ball"), std::string::npos)
      << report.message;
}

TEST_F(TrackerOnImages, FollowsOnlyABallOfTheBrightnessThatIsGiven) {
  const std::vector<RenderedImage> images = drawn(bench::makeThrow(experiment_, 4));
  for (const auto& [darkest, brightest, measured] :
       {std::make_tuple(20.0, 255.0, true), std::make_tuple(0.0, 20.0, false)}) {
    TrackerOptions options = readTracker(testing::experimentPath()).tracker;
    options.detector.darkest = darkest;
    options.detector.brightest = brightest;
    tracker_ = ThrowTracker(options);
    for (int i = 0; i < 2; ++i) {
      const sim_bullet::RigCamera& c = rig_.cameras()[static_cast<std::size_t>(i)];
      tracker_.setCamera(i, {c.camera, c.rate, c.exposure});
    }
    EXPECT_EQ(track(images).measured, measured) << darkest << " to " << brightest;
  }
}

TEST_F(TrackerOnImages, SaysSoIfTheImagesEndBeforeTheLanding) {
  SyntheticThrow synthetic = bench::makeThrow(experiment_, 1);
  synthetic.end_utime = synthetic.release_utime + 300000;
  const LandingReport report = track(drawn(synthetic));
  EXPECT_FALSE(report.measured);
  EXPECT_NE(report.message.find("the images ended"), std::string::npos) << report.message;
}

TEST_F(TrackerOnImages, SaysSoIfTheBallIsStoppedOnItsWay) {
  SyntheticThrow synthetic = bench::makeThrow(experiment_, 1);
  Eigen::Vector3d stopped = Eigen::Vector3d::Zero();
  for (sim_bullet::SceneSnapshot& s : synthetic.snapshots) {
    const double after = static_cast<double>(s.utime - synthetic.release_utime) * 1e-6 - 0.25;
    if (after < 0)
      stopped = s.p_WBall;
    else  // it falls straight down
      s.p_WBall = stopped - Eigen::Vector3d(0, 0, 4.9 * after * after);
  }
  const LandingReport report = track(drawn(synthetic));
  EXPECT_FALSE(report.measured);
  EXPECT_NE(report.message.find("not measured: the ball was lost"), std::string::npos)
      << report.message;
}

}  // namespace
}  // namespace fastball::vision_tracker
