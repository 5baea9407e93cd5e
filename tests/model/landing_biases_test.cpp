#include "model/landing_biases.h"

#include <gtest/gtest.h>

#include <random>

namespace fastball::model {
namespace {

const BallParameters kBall{0.05, 0.033, 0.47, 1.2, 5e5, 0.2, 0.8, 1e4, 20};
constexpr double kGravity = 9.81;

Target targetAt(double azimuth) {
  Target target;
  target.p_WTarget = {3 * std::cos(azimuth), 3 * std::sin(azimuth), -0.5};
  target.n_WTarget = {-std::cos(azimuth), -std::sin(azimuth), 0};
  target.radius = 0.1;
  return target;
}

BallState releaseAt(double azimuth) {
  const Eigen::AngleAxisd turn(azimuth, Eigen::Vector3d::UnitZ());
  return {turn * Eigen::Vector3d(0.2, 0.1, 0.5), turn * Eigen::Vector3d(4.9, 0.1, 1.0)};
}

TEST(LandingJacobian, IsTheChangeOfTheLanding) {
  const Target target = targetAt(0);
  const LandingJacobian H = landingJacobian(releaseAt(0), target, kBall, kGravity);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> small(-1e-3, 1e-3);
  for (int trial = 0; trial < 20; ++trial) {
    LandingBiases b;
    for (double& value : b)
      value = small(engine);
    BallState release = releaseAt(0);
    // Towards the target from (0.2, 0.1): not quite along x.
    const double yaw = std::atan2(-0.1, 2.8);
    release.v_WBall += Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * b.segment<3>(1);
    Target moved = target;
    moved.p_WTarget += b[4] * target.rightAxis() + b[5] * target.upAxis();
    const auto nominal = land(releaseAt(0), target, kBall.dragPerMetre(), kGravity);
    const auto real = land(release, moved, kBall.dragPerMetre() * (1 + b[0]), kGravity);
    EXPECT_LT((real->landing - nominal->landing - H * b).norm(), 5e-6);
  }
}

TEST(LandingJacobian, TurnsWithTheTarget) {
  const LandingJacobian ahead = landingJacobian(releaseAt(0), targetAt(0), kBall, kGravity);
  const LandingJacobian aside = landingJacobian(releaseAt(1), targetAt(1), kBall, kGravity);
  EXPECT_LT((ahead - aside).norm(), 1e-6);
}

TEST(LandingJacobian, RefusesABallThatNeverGetsThere) {
  EXPECT_THROW(landingJacobian({{0, 0, 0}, {-5, 0, 0}}, targetAt(0), kBall, kGravity),
               std::invalid_argument);
}

}  // namespace
}  // namespace fastball::model
