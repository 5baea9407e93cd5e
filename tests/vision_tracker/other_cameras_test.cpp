// The tracker with cameras that run freely, and with a single one, on drawn images of synthetic throws.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "bench/synthetic_throw.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/config.h"

namespace fastball::vision_tracker {
namespace {

using bench::SyntheticThrow;
using sim_bullet::RenderedImage;

class OtherCameras : public ::testing::Test {
 protected:
  static sim_bullet::CameraRigOptions rigOptions() {
    sim_bullet::CameraRigOptions options = sim_bullet::readCameraRig(testing::experimentPath());
    options.workers = 2;
    return options;
  }

  /// All images; the second camera's are taken `phase` [us] later than the first one's, and its clock is `ahead` [us].
  std::vector<RenderedImage> drawn(const SyntheticThrow& made,
                                   int seed,
                                   int64_t phase,
                                   int64_t ahead) {
    std::vector<RenderedImage> images = bench::renderThrow(rig_, experiment_, made, seed);
    if (phase == 0 && ahead == 0)
      return images;
    SyntheticThrow shifted = made;
    for (sim_bullet::SceneSnapshot& s : shifted.snapshots)
      s.utime -= phase;
    const std::vector<RenderedImage> later = bench::renderThrow(rig_, experiment_, shifted, seed);
    images.erase(std::remove_if(images.begin(), images.end(),
                                [](const RenderedImage& image) { return image.camera == 1; }),
                 images.end());
    for (RenderedImage image : later) {
      if (image.camera != 1)
        continue;
      image.utime += phase + ahead;
      images.push_back(image);
    }
    std::stable_sort(
        images.begin(), images.end(),
        [](const RenderedImage& a, const RenderedImage& b) { return a.utime < b.utime; });
    return images;
  }

  LandingReport track(ThrowTracker& tracker,
                      const std::vector<RenderedImage>& images,
                      int cameras) {
    for (int i = 0; i < cameras; ++i) {
      const sim_bullet::RigCamera& c = rig_.cameras()[static_cast<std::size_t>(i)];
      tracker.setCamera(i, {c.camera, c.rate, c.exposure});
    }
    tracker.begin(experiment_.target);
    LandingReport landing;
    for (const RenderedImage& image : images) {
      if (image.camera >= cameras)
        continue;
      tracker.add(image.camera, image.utime, cv::imdecode(image.jpeg, cv::IMREAD_GRAYSCALE));
      if (const auto track = tracker.takeTrack())
        last_track_ = *track;
      if (const auto report = tracker.takeLanding())
        landing = *report;
    }
    tracker.end();
    if (const auto report = tracker.takeLanding())
      landing = *report;
    return landing;
  }

  config::Experiment experiment_ = config::loadExperiment(testing::experimentPath());
  sim_bullet::CameraRig rig_{rigOptions(), experiment_.arm, experiment_.hand,
                             experiment_.ball.radius};
  TrackerOptions options_ = readTracker(testing::experimentPath()).tracker;
  TrackReport last_track_;
};

class FreeRunning : public OtherCameras,
                    public ::testing::WithParamInterface<std::pair<int64_t, int64_t>> {};

TEST_P(FreeRunning, LandsAndSaysHowFarTheClockIsAhead) {
  const auto [phase, ahead] = GetParam();
  options_.prior.clock_sigma = 2e-3;
  double normalised = 0;
  for (const int seed : {3, 8}) {
    const SyntheticThrow made = bench::makeThrow(experiment_, seed);
    ThrowTracker tracker(options_);
    const LandingReport report = track(tracker, drawn(made, seed, phase, ahead), 2);
    ASSERT_TRUE(report.measured) << report.message;
    const Eigen::Vector2d error = report.landing.landing - made.landing.landing;
    EXPECT_LT(error.norm(), 3e-3);
    normalised += error.dot(report.landing.cov.inverse() * error) / 2;
    EXPECT_GT(report.observations, 150);
    ASSERT_EQ(report.clock.size(), 2u);
    EXPECT_NEAR(report.clock[1], 1e-6 * static_cast<double>(ahead), 5 * report.clock_sigma[1]);
    EXPECT_LT(report.clock_sigma[1], 2e-4);
    ASSERT_EQ(last_track_.clock.size(), 2u);
  }
  EXPECT_LT(normalised, 8);
}

INSTANTIATE_TEST_SUITE_P(PhaseAndClock,
                         FreeRunning,
                         ::testing::Values(std::pair<int64_t, int64_t>{0, 0},
                                           std::pair<int64_t, int64_t>{0, 3000},
                                           std::pair<int64_t, int64_t>{1700, 1000},
                                           std::pair<int64_t, int64_t>{2900, -3000}));

TEST_F(OtherCameras, KnownPhasesNeedNoClocks) {
  const SyntheticThrow made = bench::makeThrow(experiment_, 3);
  ThrowTracker tracker(options_);
  const LandingReport report = track(tracker, drawn(made, 3, 2000, 0), 2);
  ASSERT_TRUE(report.measured) << report.message;
  EXPECT_LT((report.landing.landing - made.landing.landing).norm(), 3e-3);
  EXPECT_EQ(report.clock_sigma, std::vector<double>(2, 0.0));
}

TEST_F(OtherCameras, OneCameraMeasuresALanding) {
  double normalised = 0;
  constexpr int kThrows = 6;
  for (int seed = 1; seed <= kThrows; ++seed) {
    const SyntheticThrow made = bench::makeThrow(experiment_, seed);
    ThrowTracker tracker(options_);
    const LandingReport report = track(tracker, drawn(made, seed, 0, 0), 1);
    ASSERT_TRUE(report.measured) << report.message;
    const Eigen::Vector2d error = report.landing.landing - made.landing.landing;
    EXPECT_LT(error.norm(), 0.1) << "seed " << seed;
    normalised += error.dot(report.landing.cov.inverse() * error) / kThrows;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(report.landing.cov);
    EXPECT_GT(std::sqrt(axes.eigenvalues()[1] / axes.eigenvalues()[0]), 2) << "depth";
  }
  // A mean of six chi-squares of two dimensions: 2 +- 0.8.
  EXPECT_LT(normalised, 4.5);
}

}  // namespace
}  // namespace fastball::vision_tracker
