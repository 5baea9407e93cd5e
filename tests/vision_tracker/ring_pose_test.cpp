#include "vision_tracker/ring_pose.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "sim_bullet/camera_config.h"
#include "tests/vision_tracker/experiment_path.h"
#include "vision_tracker/ring_landing.h"

namespace fastball::vision_tracker {
namespace {

using fastball::testing::experimentPath;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const RingPrior kPrior{0.008, 0.03, 0.05, 0.03};
const Ring kNominal{{3.0, 0.0, -0.5}, -Eigen::Vector3d::UnitX(), 0.104};

std::vector<model::Camera> cameras() {
  std::vector<model::Camera> cameras;
  for (const sim_bullet::RigCamera& c : sim_bullet::readCameraRig(experimentPath()).cameras)
    cameras.push_back(c.camera);
  return cameras;
}

/// Places along the image of `ring` with noise of `sigma` [px].
std::vector<RingPoint> pointsOf(const Ring& ring,
                                const std::vector<model::Camera>& eyes,
                                double sigma,
                                std::mt19937& random) {
  constexpr int kPoints = 36;
  std::normal_distribution<double> normal;
  std::vector<RingPoint> points;
  for (std::size_t c = 0; c < eyes.size(); ++c) {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * M_PI * (i + 0.5) / kPoints;
      const Eigen::Vector2d along =
          eyes[c].project(ring.point(angle + 0.01)) - eyes[c].project(ring.point(angle - 0.01));
      RingPoint point;
      point.camera = static_cast<int>(c);
      point.across = Eigen::Vector2d(along.y(), -along.x()).normalized();
      point.angles = {{angle, 1.0}};
      point.place = point.across.dot(eyes[c].project(ring.point(angle))) + sigma * normal(random);
      point.variance = sigma * sigma;
      points.push_back(point);
    }
  }
  return points;
}

Ring drawn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vector6 change;
  for (double& x : change)
    x = normal(random);
  change.head<3>() *= 0.02;
  change.segment<2>(3) *= 0.03;
  change[5] *= 0.001;
  return kNominal.moved(change);
}

TEST(Ring, MovesAsItsJacobianSays) {
  constexpr double kStep = 1e-6;
  for (const double angle : {0.0, 0.3, 2.0, 5.0}) {
    Eigen::Matrix<double, 3, 6> jacobian;
    kNominal.point(angle, &jacobian);
    for (int i = 0; i < 6; ++i) {
      const Vector6 change = kStep * Vector6::Unit(i);
      const Eigen::Vector3d moved =
          (kNominal.moved(change).point(angle) - kNominal.moved(-change).point(angle)) /
          (2 * kStep);
      EXPECT_LT((moved - jacobian.col(i)).norm(), 1e-6) << i;
    }
  }
}

TEST(FitRing, IsExactWithoutNoise) {
  std::mt19937 random(3);
  const RingPrior vague{0.008, 10, 1, 0.03};
  for (int i = 0; i < 10; ++i) {
    const Ring ring = drawn(random);
    std::vector<RingPoint> points = pointsOf(ring, cameras(), 0, random);
    for (RingPoint& point : points)
      point.variance = 1e-6;
    const auto found = fitRing(points, cameras(), kNominal, vague, kNominal);
    ASSERT_TRUE(found);
    EXPECT_LT((found->ring.p_W - ring.p_W).norm(), 1e-5);
    EXPECT_LT((found->ring.n_W - ring.n_W).norm(), 1e-4);
  }
}

TEST(FitRing, StatesItsOwnCovarianceAlsoWithWrongPoints) {
  constexpr int kRings = 300;
  std::mt19937 random(11);
  double normalised = 0;
  for (int i = 0; i < kRings; ++i) {
    const Ring ring = drawn(random);
    std::vector<RingPoint> points = pointsOf(ring, cameras(), 0.05, random);
    for (const std::size_t wrong : {4UL, 17UL, 40UL})
      points[wrong].place += 1.0;
    const auto found = fitRing(points, cameras(), kNominal, kPrior, kNominal);
    ASSERT_TRUE(found);
    const Eigen::Vector3d error = found->ring.p_W - ring.p_W;
    normalised += error.dot(found->cov.topLeftCorner<3, 3>().inverse() * error);
  }
  EXPECT_NEAR(normalised / kRings, 3.0, 0.5);
}

TEST(FitRing, GainsSayWhatAWrongCalibrationDoes) {
  std::mt19937 random(2);
  const RingPrior vague{0.008, 10, 1, 0.03};
  const std::vector<model::Camera> truth = cameras();
  std::vector<RingPoint> points = pointsOf(kNominal, truth, 0, random);
  for (RingPoint& point : points)
    point.variance = 1e-4;
  const auto found = fitRing(points, truth, kNominal, vague, kNominal);
  ASSERT_TRUE(found);
  for (std::size_t c = 0; c < truth.size(); ++c) {
    for (int k = 2; k < kCameraConstants; ++k) {
      constexpr double kStep = 1e-5;
      // The images are those of a camera that is displaced from what the fit assumes.
      std::vector<model::Camera> displacedTruth = truth;
      displacedTruth[c] = displaced(truth[c], kStep * CameraConstants::Unit(k));
      std::vector<RingPoint> seen = pointsOf(kNominal, displacedTruth, 0, random);
      for (std::size_t i = 0; i < seen.size(); ++i) {
        seen[i].across = points[i].across;
        seen[i].place =
            points[i].across.dot(displacedTruth[static_cast<std::size_t>(seen[i].camera)].project(
                kNominal.point(seen[i].angles[0].first)));
        seen[i].variance = 1e-4;
      }
      const auto moved = fitRing(seen, truth, kNominal, vague, kNominal);
      ASSERT_TRUE(moved);
      const Vector6 change = between(found->ring, moved->ring) / kStep;
      const Vector6 expected = found->gains[c].col(k);
      EXPECT_LT((change - expected).norm(), 0.01 * (expected.norm() + 1e-2))
          << "camera " << c << " constant " << k;
    }
  }
}

TEST(FitRing, RefusesTooFewPoints) {
  std::mt19937 random(1);
  std::vector<RingPoint> points = pointsOf(kNominal, cameras(), 0.05, random);
  points.resize(7);
  EXPECT_FALSE(fitRing(points, cameras(), kNominal, kPrior, kNominal));
}

}  // namespace
}  // namespace fastball::vision_tracker
