// The fit alone: observations made by formula, with known noise.
#include "vision_tracker/flight_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

#include "bench/synthetic_throw.h"
#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/flight_landing.h"
#include "vision_tracker/free_flight.h"
#include "vision_tracker/sphere_outline.h"

namespace fastball::vision_tracker {
namespace {

constexpr double kGravity = 9.81;
constexpr double kSigma = 0.1;  // [px]

class FlightFit : public ::testing::Test {
 protected:
  FlightFit() {
    for (const sim_bullet::RigCamera& camera :
         sim_bullet::readCameraRig(testing::experimentPath()).cameras)
      cameras_.push_back(camera.camera);
    target_.p_WTarget = {3, 0, -0.5};
    target_.radius = 0.1;
    truth_ = {{0.4, 0.1, 0.3}, {4.6, -0.2, 1.3}};
    landing_ = model::land(truth_, target_, drag_, kGravity).value();
  }

  /// Both cameras at 240 Hz up to the share `seen` of the flight; standard deviation `sigma` [px].
  std::vector<Observation> observe(double sigma, double seen = 0.95) {
    std::normal_distribution<double> normal;
    std::vector<Observation> observations;
    for (int k = 0; k / 240.0 < seen * landing_.time; ++k) {
      for (int camera = 0; camera < 2; ++camera) {
        Observation o;
        o.utime = 5000000 + std::llround(k * 1e6 / 240);
        o.camera = camera;
        const auto state =
            model::fly(truth_, static_cast<double>(o.utime - 5000000) * 1e-6, drag_, kGravity);
        o.centre = outlineCentre(cameras_[static_cast<std::size_t>(camera)], state.p_WBall,
                                 prior_.ball_radius) +
                   sigma * Eigen::Vector2d(normal(random_), normal(random_));
        o.cov = kSigma * kSigma * Eigen::Matrix2d::Identity();
        observations.push_back(o);
      }
    }
    return observations;
  }
  /// A start that is a few centimetres and per cent wrong.
  model::BallState guess() const {
    return {truth_.p_WBall + Eigen::Vector3d(0.02, -0.03, 0.01), 1.05 * truth_.v_WBall};
  }
  std::optional<LandingEstimate> landed(const std::vector<Observation>& observations,
                                        FlightEstimate* flight = nullptr) {
    const auto fit = fitFlight(observations, 0, cameras_, prior_, guess(), 5000000);
    if (!fit)
      return std::nullopt;
    if (flight != nullptr)
      *flight = *fit;
    return landingOf(*fit, target_, kGravity);
  }
  double missed(const LandingEstimate& estimate) const {
    return (estimate.landing - landing_.landing).norm();
  }

  std::vector<model::Camera> cameras_;
  FlightPrior prior_{kGravity, 0.07, 0.021, 0.05, 1e-3};
  double drag_ = 0.08;
  model::Target target_;
  model::BallState truth_;
  model::Landing landing_;
  std::mt19937 random_{7};
};

TEST_F(FlightFit, ReturnsWhatMadeTheObservations) {
  FlightEstimate flight;
  prior_.drag_sigma = 1;  // so weak that the prior cannot draw the drag away
  const auto estimate = landed(observe(0), &flight);
  ASSERT_TRUE(estimate);
  EXPECT_LT(missed(*estimate), 1e-6);
  EXPECT_NEAR(static_cast<double>(estimate->utime - 5000000), landing_.time * 1e6, 2);
  EXPECT_NEAR(flight.drag, drag_, 1e-4);
  EXPECT_LT(flight.residual_px, 1e-4);
}

TEST_F(FlightFit, CovarianceIsWhatTheErrorsAre) {
  for (const double seen : {0.6, 0.95}) {
    constexpr int kThrows = 150;
    double sum = 0;
    for (int i = 0; i < kThrows; ++i) {
      const double drag_sigma = prior_.drag_sigma;
      drag_ = prior_.drag + drag_sigma * std::normal_distribution<double>()(random_);
      landing_ = model::land(truth_, target_, drag_, kGravity).value();
      const auto estimate = landed(observe(kSigma, seen));
      ASSERT_TRUE(estimate);
      const Eigen::Vector2d error = estimate->landing - landing_.landing;
      sum += error.dot(estimate->cov.inverse() * error);
    }
    // A mean of 150 chi-squares of two dimensions: 2 +- 0.16.
    EXPECT_NEAR(sum / kThrows, 2.0, 0.5) << "share seen " << seen;
  }
}

TEST_F(FlightFit, GainSaysWhatErrorsOfTheCamerasDo) {
  FlightEstimate flight;
  const auto estimate = landed(observe(0), &flight);
  ASSERT_TRUE(estimate);
  ASSERT_EQ(flight.gains.size(), 2u);
  const std::vector<model::Camera> assumed = cameras_;
  const CameraConstants sizes =
      (CameraConstants() << 0.02, 0.02, 1e-4, 1e-4, 1e-4, 2e-4, 2e-4, 2e-4, 1e-4).finished();
  for (std::size_t camera = 0; camera < 2; ++camera) {
    for (int i = 0; i < kCameraConstants; ++i) {
      const CameraConstants error = sizes[i] * CameraConstants::Unit(i);
      cameras_[camera] = displaced(assumed[camera], error);
      std::vector<Observation> observations = observe(0);
      for (Observation& o : observations)
        if (o.camera == static_cast<int>(camera))
          o.centre += error.head<2>();
      cameras_ = assumed;
      FlightEstimate moved;
      const auto landing = landed(observations, &moved);
      ASSERT_TRUE(landing);
      FlightVector change;
      change << moved.start.p_WBall - flight.start.p_WBall,
          moved.start.v_WBall - flight.start.v_WBall, moved.drag - flight.drag,
          Eigen::Vector3d::Zero();
      const FlightVector expected = flight.gains[camera] * error;
      EXPECT_LT((change - expected).norm(), 0.03 * expected.norm() + 2e-6)
          << "camera " << camera << " constant " << i;
      EXPECT_LT((landing->landing - estimate->landing - estimate->gains[camera] * error).norm(),
                0.03 * (landing->landing - estimate->landing).norm() + 2e-6);
    }
  }
}

TEST_F(FlightFit, CovarianceIsNoiseAndConstants) {
  prior_.calibration = {1e-3, 2e-3, 1e-3};
  FlightEstimate flight;
  const auto estimate = landed(observe(kSigma), &flight);
  ASSERT_TRUE(estimate);
  FlightCovariance cov = flight.noise_cov;
  Eigen::Matrix2d landing_cov = estimate->noise_cov;
  const CameraConstants variances = constantVariances(prior_.bias_sigma, prior_.calibration);
  for (std::size_t i = 0; i < 2; ++i) {
    cov += flight.gains[i] * variances.asDiagonal() * flight.gains[i].transpose();
    landing_cov += estimate->gains[i] * variances.asDiagonal() * estimate->gains[i].transpose();
  }
  EXPECT_LT((cov - flight.cov).norm(), 1e-9 * cov.norm());
  EXPECT_LT((landing_cov - estimate->cov).norm(), 1e-9 * landing_cov.norm());
  // Nothing of the calibration is in the noise's part.
  prior_.calibration = {};
  prior_.bias_sigma = 0;
  const auto ideal = fitFlight(observe(0), 0, cameras_, prior_, guess(), 5000000);
  ASSERT_TRUE(ideal);
  EXPECT_LT((ideal->cov - ideal->noise_cov).norm(), 1e-12 * ideal->cov.norm());
  EXPECT_LT(estimate->noise_cov.trace(), 0.5 * estimate->cov.trace());
}

TEST_F(FlightFit, CutsOutliers) {
  for (int round = 0; round < 10; ++round) {
    std::vector<Observation> observations = observe(kSigma);
    for (Observation& o : observations)
      if (random_() % 7 == 0)
        o.centre += Eigen::Vector2d(20, -15);
    const auto estimate = landed(observations);
    ASSERT_TRUE(estimate);
    EXPECT_LT(missed(*estimate), 3e-3);
  }
}

TEST_F(FlightFit, FindsWhereFreeFlightBegins) {
  // Before its flight the ball is carried: 25 times, accelerated by 30 m/s^2 along its path.
  std::vector<Observation> observations = observe(kSigma);
  std::vector<Observation> carried;
  std::normal_distribution<double> normal;
  for (int k = -25; k < 0; ++k) {
    const double t = k / 240.0;
    const Eigen::Vector3d p_W =
        truth_.p_WBall + t * truth_.v_WBall + 15 * t * t * truth_.v_WBall.normalized();
    for (int camera = 0; camera < 2; ++camera) {
      Observation o = observations.front();
      o.utime = 5000000 + std::llround(t * 1e6);
      o.camera = camera;
      o.centre =
          outlineCentre(cameras_[static_cast<std::size_t>(camera)], p_W, prior_.ball_radius) +
          kSigma * Eigen::Vector2d(normal(random_), normal(random_));
      carried.push_back(o);
    }
  }
  observations.insert(observations.begin(), carried.begin(), carried.end());
  std::size_t begin = 0;
  const auto fit = fitFreeFlight(observations, cameras_, prior_, guess(), 5000000, &begin);
  ASSERT_TRUE(fit);
  EXPECT_GT(begin, 30u);
  EXPECT_LT(begin, 62u);
  const auto estimate = landingOf(*fit, target_, kGravity);
  ASSERT_TRUE(estimate);
  EXPECT_LT(missed(*estimate), 2e-3);
}

TEST_F(FlightFit, UsesTheWholeFlightIfAllOfItIsFree) {
  std::size_t begin = 99;
  const auto fit = fitFreeFlight(observe(kSigma), cameras_, prior_, guess(), 5000000, &begin);
  ASSERT_TRUE(fit);
  EXPECT_LT(begin, 12u);
}

TEST_F(FlightFit, FollowedFlightIsThatOfTheFullSearch) {
  std::vector<Observation> all = observe(kSigma);
  for (std::size_t i = 0; i < all.size(); i += 23)
    all[i].centre += Eigen::Vector2d(12, -9);
  FreeFlight followed;
  followed.flight.start = guess();
  followed.flight.utime = 5000000;
  int searches = 0;
  for (std::size_t n = 40; n < all.size(); n += 2) {
    const std::vector<Observation> seen(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
    const auto next = followFreeFlight(seen, cameras_, prior_, followed);
    ASSERT_TRUE(next) << n;
    searches += next->searched != followed.searched ? 1 : 0;
    followed = *next;
    const auto whole = refitFlight(seen, followed.begin, cameras_, prior_, followed.flight);
    ASSERT_TRUE(whole);
    EXPECT_LT((whole->start.p_WBall - followed.flight.start.p_WBall).norm(), 1e-6) << n;
    EXPECT_LT((whole->start.v_WBall - followed.flight.start.v_WBall).norm(), 1e-5) << n;
  }
  EXPECT_LT(followed.begin, 12u);
  EXPECT_LT(4 * searches, static_cast<int>(all.size()));
  const auto searched = fitFreeFlight(all, cameras_, prior_, guess(), 5000000, nullptr);
  ASSERT_TRUE(searched);
  const auto a = landingOf(followed.flight, target_, kGravity);
  const auto b = landingOf(*searched, target_, kGravity);
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->landing - b->landing).norm(), std::sqrt(b->cov.trace()));
}

TEST_F(FlightFit, RefusesTooFewObservations) {
  std::vector<Observation> observations = observe(kSigma);
  observations.resize(7);
  EXPECT_FALSE(landed(observations));
  EXPECT_FALSE(fitFreeFlight({}, cameras_, prior_, guess(), 5000000, nullptr));
}

TEST_F(FlightFit, RefusesMoreCamerasThanItHasClocksFor) {
  cameras_.resize(model::kMostCameras + 1, cameras_.front());
  EXPECT_THROW(fitFlight(observe(kSigma), 0, cameras_, prior_, guess(), 5000000),
               std::invalid_argument);
}

TEST_F(FlightFit, LandsNowhereIfThePlaneIsNotCrossed) {
  FlightEstimate away;
  away.start = {{0, 0, 0}, {-4, 0, 1}};
  EXPECT_FALSE(landingOf(away, target_, kGravity));
}

}  // namespace
}  // namespace fastball::vision_tracker
