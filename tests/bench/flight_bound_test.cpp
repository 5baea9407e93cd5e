// The Cramer-Rao bound against cases that can be reckoned by hand, and the tracker's fit against the bound.
#include "bench/flight_bound.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "bench/flight_trials.h"
#include "sim_bullet/camera_config.h"
#include "vision_tracker/config.h"

namespace fastball::bench {
namespace {

constexpr double kGravity = 9.81;

std::string experimentPath() {
  return FASTBALL_SOURCE_DIR "/config/experiment.yaml";
}

class FlightBound : public ::testing::Test {
 protected:
  FlightBound() {
    target_.p_WTarget = {3, 0, -0.5};
    target_.radius = 0.1;
    for (const sim_bullet::RigCamera& camera : sim_bullet::readCameraRig(experimentPath()).cameras)
      cameras_.push_back(camera.camera);
  }
  std::vector<View> views(double sigma, double seen, int cameras = 2, double rate = 240) const {
    std::vector<View> views;
    const double duration = model::land(start_, target_, knowledge_.drag, kGravity)->time;
    for (int k = 0; k / rate < seen * duration; ++k)
      for (int camera = 0; camera < cameras; ++camera)
        views.push_back({k / rate, camera, sigma});
    return views;
  }
  Eigen::Matrix2d bound(const std::vector<View>& views) const {
    return landingBound(start_, views, cameras_, target_, knowledge_);
  }

  model::BallState start_{{0.3, 0.05, 0.3}, {4.8, -0.1, 1.4}};
  model::Target target_;
  std::vector<model::Camera> cameras_;
  FlightKnowledge knowledge_{kGravity, 0.07, 0.02, 0.05};
};

TEST_F(FlightBound, GrowsWithTheSquareOfTheNoiseIfDragIsKnown) {
  knowledge_.drag_sigma = 1e-9;
  const Eigen::Matrix2d one = bound(views(0.1, 1)), two = bound(views(0.2, 1));
  EXPECT_LT((two - 4 * one).norm(), 1e-4 * two.norm());
}

TEST_F(FlightBound, IsThatOfAStraightLineInOneDirection) {
  // Of y(t), without gravity and drag in it, the landing extrapolates a straight line: with many views of a whole flight its
  // variance is 4 sigma^2 / N. A camera that looks along the flight from far behind sees y directly.
  knowledge_.drag = 0;
  knowledge_.drag_sigma = 1e-9;
  start_.v_WBall.y() = 0;
  model::Camera behind;
  behind.width = behind.height = 4000;
  behind.fx = behind.fy = 1e5;
  behind.cx = behind.cy = 2000;
  sim_bullet::lookAt({-1000, 0, 0}, {0, 0, 0}, behind);
  model::Camera beside = behind;
  sim_bullet::lookAt({1.5, -1000, 0}, {1.5, 0, 0}, beside);
  cameras_ = {behind, beside};
  const std::vector<View> seen = views(0.1, 1, 2, 1000);
  const double sigma_m = 0.1 * 1000 / 1e5;
  const double expected = 4 * sigma_m * sigma_m / (static_cast<double>(seen.size()) / 2);
  EXPECT_NEAR(bound(seen)(0, 0), expected, 0.02 * expected);
}

TEST_F(FlightBound, GrowsWithTheClocksUncertaintyUpToALimit) {
  const std::vector<View> seen = views(0.1, 1);
  const double one = bound(seen).trace();
  knowledge_.clock_sigma = 1e-8;
  EXPECT_NEAR(bound(seen).trace(), one, 1e-4 * one);
  double before = one;
  for (const double sigma : {1e-5, 1e-4, 1e-3}) {
    knowledge_.clock_sigma = sigma;
    EXPECT_GT(bound(seen).trace(), before);
    before = bound(seen).trace();
  }
  // The flight itself tells the clocks then.
  knowledge_.clock_sigma = 1;
  EXPECT_LT(bound(seen).trace(), 1.1 * before);
}

TEST_F(FlightBound, IsReachedWithUncertainClocks) {
  const config::Experiment experiment = config::loadExperiment(experimentPath());
  vision_tracker::TrackerOptions tracker = vision_tracker::readTracker(experimentPath()).tracker;
  tracker.prior.clock_sigma = 2e-3;
  tracker.prior.bias_sigma = 1e-4;
  FlightTrialOptions options;
  options.throws = 150;
  options.sigma = 0.1;
  const FlightTrialResult result = flightTrials(cameras_, 240, experiment, tracker, options);
  EXPECT_EQ(result.failures, 0);
  // Standard error of 150 throws: 6 %.
  EXPECT_LT(result.ratio(), 1.2);
  EXPECT_GT(result.ratio(), 0.8);
  EXPECT_NEAR(result.nees, 2, 0.7);
}

TEST_F(FlightBound, FallsWithEveryView) {
  const double all = bound(views(0.1, 1)).trace(), some = bound(views(0.1, 0.6)).trace();
  EXPECT_GT(some, 2 * all);
  EXPECT_LT(bound(views(0.1, 1, 2, 480)).trace(), all);
}

TEST_F(FlightBound, RefusesWhatDoesNotDetermineAFlight) {
  EXPECT_THROW(bound({{0, 0, 0.1}}), std::invalid_argument);
  start_.v_WBall = {-1, 0, 0};
  EXPECT_THROW(bound(std::vector<View>{{0, 0, 0.1}, {0.1, 1, 0.1}, {0.2, 0, 0.1}, {0.3, 1, 0.1}}),
               std::invalid_argument);
}

class FlightTrials : public FlightBound {
 protected:
  FlightTrialResult fly(const FlightTrialOptions& options) const {
    return flightTrials(cameras_, 240, experiment_, tracker_, options);
  }
  config::Experiment experiment_ = config::loadExperiment(experimentPath());
  vision_tracker::TrackerOptions tracker_ = vision_tracker::readTracker(experimentPath()).tracker;
};

TEST_F(FlightTrials, TheFitReachesTheBound) {
  FlightTrialOptions options;
  options.throws = 200;
  options.seed = 5;
  for (const double seen : {1.0, 0.6}) {
    options.seen = seen;
    const FlightTrialResult result = fly(options);
    EXPECT_EQ(result.failures, 0);
    EXPECT_NEAR(result.ratio(), 1, 0.15) << "three standard errors";
    EXPECT_NEAR(result.nees, 2, 0.5) << "three standard errors";
  }
}

TEST_F(FlightTrials, LostImagesAndOutliersCostLittleMoreThanTheirShare) {
  FlightTrialOptions options;
  options.throws = 200;
  options.seed = 6;
  const double clean = fly(options).ratio();
  options.lost = 0.1;
  options.outliers = 0.05;
  const FlightTrialResult dirty = fly(options);
  EXPECT_EQ(dirty.failures, 0);
  EXPECT_LT(dirty.ratio(), 1.2 * clean);
}

TEST_F(FlightTrials, ErrorsOfTheCalibrationAreInTheCovariance) {
  FlightTrialOptions options;
  options.throws = 200;
  options.seed = 7;
  options.calibration = {0.5e-3, 1e-3, 1e-3};
  EXPECT_LT(fly(options).inside, 0.2) << "a tracker that believes its calibration";
  tracker_.prior.calibration = options.calibration;
  EXPECT_NEAR(fly(options).inside, 0.95, 0.05);
}

}  // namespace
}  // namespace fastball::bench
