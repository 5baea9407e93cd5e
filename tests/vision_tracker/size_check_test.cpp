#include "vision_tracker/size_check.h"

#include <gtest/gtest.h>

#include "config/experiment.h"
#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/config.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

class SizeChecks : public ::testing::Test {
 protected:
  SizeChecks() {
    for (const auto& rig : sim_bullet::readCameraRig(::fastball::testing::experimentPath()).cameras)
      cameras_.push_back(rig.camera);
    landing_.utime = 5'000'000;
    landing_.state = {{3, 0.02, -0.5}, {3.5, 0.1, -4.2}};
  }
  /// Sightings of the flight before the landing, `factor` as large as they should be.
  void see(int camera, double factor, int count) {
    for (int i = 1; i <= count; ++i) {
      const double time = -4.167e-3 * i;
      const model::BallState ball =
          model::fly(landing_.state, time, 0.8 * prior_.drag, prior_.gravity);
      BallFit fit;
      fit.radius = factor * sphereOutline(cameras_[static_cast<std::size_t>(camera)], ball.p_WBall,
                                          prior_.ball_radius)
                                .meanRadius();
      check_.add(camera, landing_.utime - 4167 * i, fit);
    }
  }

  FlightPrior prior_ = readTracker(::fastball::testing::experimentPath()).tracker.prior;
  std::vector<model::Camera> cameras_;
  LandingEstimate landing_;
  SizeCheck check_;
};

TEST_F(SizeChecks, FindTheCameraWhoseBallIsFarthestFromItsSize) {
  see(0, 1.01, 60);
  see(1, 0.92, 60);
  EXPECT_NEAR(check_.excess(landing_, cameras_, prior_).value_or(1), -0.08, 2e-3);
}

TEST_F(SizeChecks, BearAFewWrongSizes) {
  see(0, 1.0, 50);
  see(0, 0.4, 20);
  EXPECT_NEAR(check_.excess(landing_, cameras_, prior_).value_or(1), 0, 2e-3);
}

TEST_F(SizeChecks, SayNothingOfTooFew) {
  see(0, 1.5, 7);
  EXPECT_FALSE(check_.excess(landing_, cameras_, prior_));
  see(1, 1.0, 8);
  EXPECT_NEAR(check_.excess(landing_, cameras_, prior_).value_or(1), 0, 2e-3);
  check_.reset();
  EXPECT_FALSE(check_.excess(landing_, cameras_, prior_));
}

}  // namespace
}  // namespace fastball::vision_tracker
