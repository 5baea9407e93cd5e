#include "model/contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

const Eigen::Vector3d kNormal = Eigen::Vector3d::UnitZ();

TEST(ElasticLaw, HasTheValuesOfEquation27) {
  const BallParameters ball = exampleBall();
  EXPECT_EQ(elasticForce(ball, 0), 0);
  EXPECT_EQ(elasticForce(ball, -0.01), 0);
  EXPECT_DOUBLE_EQ(elasticForce(ball, 0.01), M_PI * 5e5 * 0.8 * 1e-4);
  EXPECT_NEAR(elasticForce(ball, 1e-9), M_PI * 5e5 * 1e-18, 1e-18);
  BallParameters soft = ball;
  soft.youngs_modulus = 1e5;
  EXPECT_NEAR(deformation(soft, 12), 6.64e-3, 5e-6);
}

TEST(ElasticLaw, NeverFallsWithDeformation) {
  const BallParameters ball = exampleBall();
  const double y_max = 2 * ball.radius / 3;
  EXPECT_NEAR(elasticForce(ball, y_max), maximumForce(ball), 1e-9);
  EXPECT_LT(elasticForce(ball, 0.999 * y_max), maximumForce(ball));
  double before = 0;
  for (int i = 0; i < 1500; ++i) {
    const double y = i * 1e-4;
    EXPECT_GE(elasticForce(ball, y), before - 1e-9);
    before = elasticForce(ball, y);
  }
  EXPECT_EQ(elasticStiffness(ball, 1.1 * y_max), 0);
}

TEST(ElasticLaw, StiffnessAndEnergyAreItsDerivativeAndIntegral) {
  const BallParameters ball = exampleBall();
  const double h = 1e-7;
  for (int i = 0; i < 40; ++i) {
    const double y = 1e-4 + i * 1.1e-3;
    const double slope = (elasticForce(ball, y + h) - elasticForce(ball, y - h)) / (2 * h);
    EXPECT_NEAR(elasticStiffness(ball, y), slope, 1e-5 * slope + 1e-3);
    const double work = (elasticEnergy(ball, y + h) - elasticEnergy(ball, y - h)) / (2 * h);
    EXPECT_NEAR(elasticForce(ball, y), work, 1e-6 * work);
  }
  EXPECT_EQ(elasticEnergy(ball, 0), 0);
  EXPECT_EQ(elasticEnergy(ball, -1), 0);
}

TEST(ElasticLaw, DeformationIsItsInverse) {
  BallParameters ball = exampleBall();
  for (const double modulus : {2e4, 5e5, 1e7}) {
    ball.youngs_modulus = modulus;
    EXPECT_EQ(deformation(ball, 0), 0);
    for (const double part : {1e-12, 1e-6, 0.01, 0.3, 0.9, 0.999999}) {
      const double force = part * maximumForce(ball);
      const double y = deformation(ball, force);
      EXPECT_LE(y, 2 * ball.radius / 3);
      EXPECT_NEAR(elasticForce(ball, y), force, 1e-11 * force);
    }
    EXPECT_NEAR(deformation(ball, maximumForce(ball)), 2 * ball.radius / 3, 1e-9);
  }
}

TEST(ElasticLaw, RefusesAForceItCannotCarry) {
  BallParameters ball = exampleBall();
  ball.youngs_modulus = 1e4;
  try {
    deformation(ball, 18);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("18 N"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("11.6"));
  }
  EXPECT_THROW(deformation(ball, -1e-9), std::invalid_argument);
  EXPECT_THROW(deformation(ball, std::nan("")), std::invalid_argument);
}

TEST(Contact, PushesAlongTheNormalAndNeverPulls) {
  const BallParameters ball = exampleBall();
  Contact contact;
  EXPECT_EQ(contact.step(ball, kNormal, 0, {1, 1, -1}, 1e-4).norm(), 0);
  EXPECT_EQ(contact.step(ball, kNormal, -1e-3, {0, 0, -1}, 1e-4).norm(), 0);
  const double y = 2e-3;
  const double still = contact.step(ball, kNormal, y, Eigen::Vector3d::Zero(), 1e-4).z();
  EXPECT_DOUBLE_EQ(still, elasticForce(ball, y));
  const double damping = 2 * 0.2 * std::sqrt(elasticStiffness(ball, y) * ball.mass);
  EXPECT_NEAR(contact.step(ball, kNormal, y, {0, 0, -0.1}, 1e-4).z(), still + 0.1 * damping, 1e-12);
  EXPECT_EQ(contact.step(ball, kNormal, y, {0, 0, 100}, 1e-4).norm(), 0);
}

TEST(Contact, FrictionStaysInItsConeAndOpposesTheSlip) {
  const BallParameters ball = exampleBall();
  std::mt19937 random(2);
  std::uniform_real_distribution<> uniform(-1, 1);
  Contact contact;
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d n =
        (kNormal + 0.1 * Eigen::Vector3d(uniform(random), uniform(random), 0)).normalized();
    const Eigen::Vector3d v(uniform(random), uniform(random), 0.05 * uniform(random));
    const Eigen::Vector3d force = contact.step(ball, n, 2e-3 * (1 + uniform(random)), v, 1e-4);
    const double normal = force.dot(n);
    EXPECT_LE((force - normal * n).norm(), ball.friction * normal + 1e-9);
    EXPECT_NEAR(contact.bristle().dot(n), 0, 1e-9);
  }
  contact.reset();
  Eigen::Vector3d force;
  for (int i = 0; i < 1000; ++i)
    force = contact.step(ball, kNormal, 2e-3, {0.5, 0, 0}, 1e-4);
  EXPECT_TRUE(contact.slipping());
  EXPECT_NEAR(contact.bristle().x(), -force.x() / ball.bristle_stiffness, 1e-9);
  EXPECT_NEAR(force.x(), -ball.friction * elasticForce(ball, 2e-3), 1e-9);
}

/// Pulls a mass of 33 g for one second, with a force that grows to `load` [N] in half of it; where it is and how fast.
Eigen::Vector2d pulledFor1s(double load) {
  const BallParameters ball = exampleBall();
  Contact contact;
  double x = 0, v = 0;
  for (int i = 0; i < 10000; ++i) {
    const double force = contact.step(ball, kNormal, 2e-3, {v, 0, 0}, 1e-4).x();
    v += 1e-4 * (force + load * std::min(1.0, i / 5000.0)) / ball.mass;
    x += 1e-4 * v;
  }
  return {x, v};
}

TEST(Contact, BristleHoldsUpToTheLimitWithoutCreep) {
  const BallParameters ball = exampleBall();
  const double limit = ball.friction * elasticForce(ball, 2e-3);
  for (const double part : {0.0, 0.1, 0.9}) {
    const Eigen::Vector2d held = pulledFor1s(part * limit);
    EXPECT_NEAR(held[0], part * limit / ball.bristle_stiffness, 1e-9);
    EXPECT_NEAR(held[1], 0, 1e-9);
  }
  EXPECT_GT(pulledFor1s(1.1 * limit)[1], 0.4 * 0.1 * limit / ball.mass);
}

TEST(Contact, BristleHoldsNoMoreEnergyThanWentIn) {
  const BallParameters ball = exampleBall();
  std::mt19937 random(7);
  std::uniform_real_distribution<> uniform(-1, 1);
  for (const double speed : {1e-6, 0.01, 1.0, 100.0}) {
    Contact contact;
    double work = 0;
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d v(speed * uniform(random), speed * uniform(random), 0);
      work -= contact.step(ball, kNormal, 2e-3, v, 1e-4).dot(v) * 1e-4;
      const double held = ball.bristle_stiffness * contact.bristle().squaredNorm() / 2;
      EXPECT_LE(held, work * (1 + 1e-9)) << speed << " m/s, step " << i;
    }
  }
}

TEST(Contact, NeverCreatesEnergyOverACycle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> uniform(0, 1);
  for (int i = 0; i < 100; ++i) {
    BallParameters ball = exampleBall();
    ball.damping_ratio = i % 2 == 0 ? 0 : uniform(random);
    // Presses y = depth sin^2 and slides along an ellipse, with a step of 1e-5 of the cycle.
    const double period = 0.002 + 0.1 * uniform(random), depth = 0.02 * uniform(random);
    const double a = 0.01 * uniform(random), b = 0.01 * uniform(random);
    const double phase = 2 * M_PI * uniform(random);
    const double w = 2 * M_PI / period, dt = period / 100000;
    Contact contact;
    double work = 0;  // of the finger on the ball
    for (int k = 0; k < 100000; ++k) {
      const double t = k * dt;
      const double y = depth * std::pow(std::sin(w * t / 2), 2);
      const Eigen::Vector3d v(-a * w * std::sin(w * t + phase), b * w * std::cos(w * t + phase),
                              -depth * w / 2 * std::sin(w * t));
      work += contact.step(ball, kNormal, y, v, dt).dot(v) * dt;
    }
    EXPECT_LE(work, 1e-9) << "cycle " << i;
  }
}

TEST(Contact, UndampedBallBouncesWithItsSpeedADampedOneSlower) {
  for (const double zeta : {0.0, 0.2, 1.0}) {
    BallParameters ball = exampleBall();
    ball.damping_ratio = zeta;
    Contact contact;
    double y = 0, v = -1;  // of the ball, upwards
    do {
      const double force = contact.step(ball, kNormal, y, {0, 0, v}, 1e-6).z();
      v += 1e-6 * force / ball.mass;
      y -= 1e-6 * v;
    } while (y > 0);
    if (zeta == 0) {
      EXPECT_NEAR(v, 1, 1e-4);
    } else {
      EXPECT_LT(v, 1 - 0.9 * zeta / (1 + zeta));
    }
  }
}

}  // namespace
}  // namespace fastball::model
