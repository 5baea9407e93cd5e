// Clocks, spin, one camera and many: what the fit estimates beside start and drag, on observations made by formula.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/flight_fit.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kGravity = 9.81;
constexpr double kSigma = 0.1;       // [px]
constexpr double kRate = 240;        // [Hz]
constexpr int64_t kStart = 5000000;  // [us]

/// One camera's clock.
struct Clock {
  double phase = 0;  ///< [s], of its first image
  double ahead = 0;  ///< [s]
};

/// Sums over throws.
struct Score {
  int throws = 0;
  double nees = 0;   ///< of the landing
  double clock = 0;  ///< squared error of the second camera's clock over its variance
  double worst = 0;  ///< [m], of the landing
};

class FlightUnknowns : public ::testing::Test {
 protected:
  FlightUnknowns() {
    for (const sim_bullet::RigCamera& camera :
         sim_bullet::readCameraRig(testing::experimentPath()).cameras)
      cameras_.push_back(camera.camera);
    target_.p_WTarget = {3, 0, -0.5};
    target_.radius = 0.1;
    prior_.bias_sigma = 1e-4;
  }

  double normal(double sigma) { return sigma * std::normal_distribution<double>()(random_); }

  /// Another throw: start, drag, and if the prior has it, lift.
  void makeThrow() {
    truth_.p_WBall = Eigen::Vector3d(0.4 + normal(0.03), 0.1 + normal(0.03), 0.3 + normal(0.03));
    truth_.v_WBall = Eigen::Vector3d(4.6 + normal(0.1), -0.2 + normal(0.1), 1.3 + normal(0.1));
    drag_ = prior_.drag + normal(prior_.drag_sigma);
    for (int i = 0; i < 3; ++i)
      lift_[i] = normal(prior_.magnus_sigma);
    FlightEstimate flight;
    flight.start = truth_;
    flight.drag = drag_;
    flight.lift = lift_;
    landing_ = landingOf(flight, target_, kGravity).value();
    size_ = normal(prior_.radius_sigma);
  }

  std::vector<Observation> observe(const std::vector<Clock>& clocks) {
    std::vector<Observation> observations;
    const double end = 0.95e-6 * static_cast<double>(landing_.utime);
    for (int camera = 0; camera < static_cast<int>(cameras_.size()); ++camera) {
      const auto c = static_cast<std::size_t>(camera);
      for (int k = 0; k / kRate < end; ++k) {
        const double time = k / kRate + clocks[c].phase;
        const Eigen::Vector3d p_W = flyLifted(truth_, time, drag_, lift_, kGravity).p_WBall;
        Observation o;
        o.utime = kStart + std::llround((time + clocks[c].ahead) * 1e6);
        o.camera = camera;
        o.centre = outlineCentre(cameras_[c], p_W, prior_.ball_radius) +
                   Eigen::Vector2d(normal(kSigma), normal(kSigma));
        o.cov = kSigma * kSigma * Eigen::Matrix2d::Identity();
        o.radius = (1 + size_) * sphereOutline(cameras_[c], p_W, prior_.ball_radius).meanRadius() +
                   normal(kSigma);
        o.radius_variance = kSigma * kSigma;
        observations.push_back(o);
      }
    }
    std::stable_sort(observations.begin(), observations.end(),
                     [](const Observation& a, const Observation& b) { return a.utime < b.utime; });
    return observations;
  }

  std::optional<FlightEstimate> fit(const std::vector<Observation>& observations) {
    const model::BallState guess{truth_.p_WBall + Eigen::Vector3d(0.02, -0.03, 0.01),
                                 1.05 * truth_.v_WBall};
    return fitFlight(observations, 0, cameras_, prior_, guess, kStart);
  }

  Score score(int throws, const std::vector<Clock>& clocks) {
    Score sum;
    for (int i = 0; i < throws; ++i) {
      makeThrow();
      flight_ = fit(observe(clocks));
      const auto landing =
          flight_ ? landingOf(*flight_, target_, kGravity) : std::optional<LandingEstimate>();
      if (!landing)
        continue;
      ++sum.throws;
      const Eigen::Vector2d error = landing->landing - landing_.landing;
      sum.nees += error.dot(landing->cov.inverse() * error) / throws;
      sum.worst = std::max(sum.worst, error.norm());
      last_ = *landing;
      if (prior_.clock_sigma > 0)
        sum.clock +=
            std::pow((flight_->clock[1] - clocks[1].ahead) / flight_->clock_sigma[1], 2) / throws;
    }
    return sum;
  }

  std::vector<model::Camera> cameras_;
  FlightPrior prior_{kGravity, 0.07, 0.021, 0.05, 1e-3};
  double drag_ = 0.07, size_ = 0;
  Eigen::Vector3d lift_ = Eigen::Vector3d::Zero();
  model::Target target_;
  model::BallState truth_;
  LandingEstimate landing_, last_;
  std::optional<FlightEstimate> flight_;
  std::mt19937 random_{11};
};

TEST_F(FlightUnknowns, FindsHowFarAClockIsAhead) {
  prior_.clock_sigma = 2e-3;
  for (const double ahead : {0.0, 1e-3, 3e-3}) {
    for (const double phase : {0.0, 1.7e-3}) {
      const Score sum = score(60, {{0, 0}, {phase, ahead}});
      ASSERT_EQ(sum.throws, 60);
      EXPECT_LT(flight_->clock_sigma[1], 2e-4) << "an eighth of what was known before";
      EXPECT_EQ(flight_->clock[0], 0);
      // Means of 60 chi-squares of one and of two dimensions: 1 +- 0.18, 2 +- 0.26.
      EXPECT_NEAR(sum.clock, 1, 0.6) << "ahead " << ahead << " phase " << phase;
      EXPECT_NEAR(sum.nees, 2, 0.8) << "ahead " << ahead << " phase " << phase;
    }
  }
}

TEST_F(FlightUnknowns, ALateClockThatIsBelievedSpoilsTheLanding) {
  const Score sum = score(20, {{0, 0}, {0, 3e-3}});
  EXPECT_GT(sum.worst, 5e-3);
}

TEST_F(FlightUnknowns, LosesNothingByClocksThatAreOne) {
  const Score sum = score(60, {{0, 0}, {0, 0}});
  ASSERT_EQ(sum.throws, 60);
  EXPECT_NEAR(sum.nees, 2, 0.8);
  EXPECT_EQ(flight_->clock, std::vector<double>(2, 0.0));
  EXPECT_EQ(flight_->clock_sigma, std::vector<double>(2, 0.0));
  EXPECT_TRUE(flight_->lift.isZero(0));
  EXPECT_TRUE(flight_->cov.bottomRows<3>().isZero(0));
}

TEST_F(FlightUnknowns, OneCameraSeesTheDepthByTheRadius) {
  cameras_.resize(1);
  const Score sum = score(100, {{0, 0}});
  ASSERT_EQ(sum.throws, 100);
  EXPECT_NEAR(sum.nees, 2, 0.8);
  // Depth is what it knows least.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(last_.cov);
  EXPECT_GT(std::sqrt(axes.eigenvalues()[1] / axes.eigenvalues()[0]), 2);
  const Eigen::Vector3d long_W = axes.eigenvectors()(0, 1) * target_.rightAxis() +
                                 axes.eigenvectors()(1, 1) * target_.upAxis();
  const Eigen::Vector3d axis_W = cameras_[0].R_CW.row(2).transpose();
  const Eigen::Vector3d in_plane =
      (axis_W - axis_W.dot(target_.n_WTarget) * target_.n_WTarget).normalized();
  EXPECT_GT(std::abs(long_W.dot(in_plane)), 0.8);
}

TEST_F(FlightUnknowns, OneCameraWithoutRadiiKnowsLess) {
  cameras_.resize(1);
  makeThrow();
  std::vector<Observation> observations = observe({{0, 0}});
  observations.resize(24);  // 0.1 s: gravity tells little of the depth yet
  const auto with = fit(observations);
  for (Observation& o : observations)
    o.radius_variance = 0;
  const auto without = fit(observations);
  ASSERT_TRUE(with && without);
  const double near = with->cov.diagonal().head(3).sum();
  EXPECT_LT(near, 0.9 * without->cov.diagonal().head(3).sum());
}

TEST_F(FlightUnknowns, ThreeAndFourCamerasSeeBetterThanTwo) {
  prior_.clock_sigma = 2e-3;
  double before = 0;
  const std::vector<Clock> clocks = {{0, 0}, {1.7e-3, 1e-3}, {0.9e-3, -2e-3}, {3.1e-3, 3e-3}};
  for (std::size_t count = 2; count <= 4; ++count) {
    while (cameras_.size() < count) {
      // On the other side of the flight, farther and farther up.
      model::Camera camera = cameras_[cameras_.size() - 2];
      CameraConstants moved = CameraConstants::Zero();
      moved.segment<3>(5) << 0.1, 0.05, 0.3;
      cameras_.push_back(displaced(camera, moved));
    }
    const Score sum = score(40, clocks);
    ASSERT_EQ(sum.throws, 40);
    EXPECT_NEAR(sum.nees, 2, 1) << count << " cameras";
    ASSERT_EQ(flight_->clock.size(), count);
    for (std::size_t i = 1; i < count; ++i)
      EXPECT_LT(std::abs(flight_->clock[i] - clocks[i].ahead), 5 * flight_->clock_sigma[i]);
    const double size = std::sqrt(last_.cov.trace());
    if (before > 0) {
      EXPECT_LT(size, before);
    }
    before = size;
  }
}

TEST_F(FlightUnknowns, FindsTheLiftOfASpinningBall) {
  prior_.magnus_sigma = 0.1;
  const Score sum = score(60, {{0, 0}, {0, 0}});
  ASSERT_EQ(sum.throws, 60);
  EXPECT_NEAR(sum.nees, 2, 0.8);
  for (int i = 0; i < 3; ++i) {
    const double sigma = std::sqrt(flight_->cov(7 + i, 7 + i));
    EXPECT_LT(std::abs(flight_->lift[i] - lift_[i]), 4 * sigma) << i;
    EXPECT_LT(sigma, 1.001 * prior_.magnus_sigma);
  }
  // Along the flight no lift can be seen; across it can.
  const Eigen::Matrix3d cov = flight_->cov.bottomRightCorner(3, 3);
  EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov).eigenvalues()[0], 0.05 * 0.05);
}

TEST_F(FlightUnknowns, LiftThatIsNotLookedForSpoilsTheLanding) {
  prior_.magnus_sigma = 0.1;
  makeThrow();
  lift_ = {0, -0.2, 0};
  FlightEstimate truth;
  truth.start = truth_;
  truth.drag = drag_;
  truth.lift = lift_;
  landing_ = landingOf(truth, target_, kGravity).value();
  std::vector<Observation> observations = observe({{0, 0}, {0, 0}});
  observations.resize(observations.size() * 6 / 10);
  const auto with = fit(observations);
  prior_.magnus_sigma = 0;
  const auto without = fit(observations);
  ASSERT_TRUE(with && without);
  const auto near = landingOf(*with, target_, kGravity),
             far = landingOf(*without, target_, kGravity);
  ASSERT_TRUE(near && far);
  EXPECT_LT((near->landing - landing_.landing).norm(), (far->landing - landing_.landing).norm());
}

}  // namespace
}  // namespace fastball::vision_tracker
