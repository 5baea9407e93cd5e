// What the fingertips' sensors make of the forces.
#include "sim_bullet/tactile_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

constexpr double kStep = 1e-4;  // [s]

FingertipForces forces(double normal) {
  FingertipForces force;
  for (FingerForce& finger : force)
    finger = {normal, Eigen::Vector2d(-normal, 2 * normal)};
  return force;
}

FingertipForces tick(TactileSensor& sensor, double normal) {
  for (int i = 0; i < 10; ++i)
    sensor.step(forces(normal));
  return sensor.read();
}

TEST(TactileSensor, WithoutErrorsItReadsTheMeanOverTheTick) {
  TactileSensor sensor({}, kStep, 1);
  for (int i = 0; i < 10; ++i)
    sensor.step(forces(i));
  const FingertipForces felt = sensor.read();
  for (const FingerForce& finger : felt) {
    EXPECT_DOUBLE_EQ(finger.normal, 4.5);
    EXPECT_LT((finger.tangential - Eigen::Vector2d(-4.5, 9)).norm(), 1e-12);
  }
}

TEST(TactileSensor, ReadsLateByTheDelay) {
  TactileSensor sensor({0, 0.0015, 0}, kStep, 1);
  EXPECT_EQ(tick(sensor, 1)[0].normal, 0);
  EXPECT_DOUBLE_EQ(tick(sensor, 2)[0].normal, 0.5) << "the half of the first tick";
  EXPECT_DOUBLE_EQ(tick(sensor, 2)[0].normal, 1.5);
  EXPECT_DOUBLE_EQ(tick(sensor, 2)[0].normal, 2);
}

TEST(TactileSensor, NoiseHasItsSizeAndReadingsTheirSteps) {
  constexpr double kNoise = 0.02, kResolution = 0.003125;
  constexpr int kTicks = 3000;
  TactileSensor sensor({kNoise, 0, kResolution}, kStep, 5);
  double sum = 0, squares = 0;
  for (int i = 0; i < kTicks; ++i) {
    const double error = tick(sensor, 3.0)[1].tangential[1] - 6.0;
    const double steps = (error + 6.0) / kResolution;
    ASSERT_NEAR(steps, std::round(steps), 1e-9);
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kTicks, 0, 4 * kNoise / std::sqrt(kTicks));
  EXPECT_NEAR(std::sqrt(squares / kTicks), kNoise, 0.05 * kNoise);
}

TEST(TactileSensor, ANormalForceIsNeverBelowZero) {
  TactileSensor sensor({0.02, 0, 0}, kStep, 5);
  for (int i = 0; i < 100; ++i)
    EXPECT_GE(tick(sensor, 0)[0].normal, 0);
}

TEST(TactileSensor, TheSameSeedFeelsTheSame) {
  TactileSensor first(simulation().tactile, kStep, 3), second(simulation().tactile, kStep, 3),
      other(simulation().tactile, kStep, 4);
  int differing = 0;
  for (int i = 0; i < 50; ++i) {
    const FingertipForces a = tick(first, 1), b = tick(second, 1), c = tick(other, 1);
    for (int finger = 0; finger < model::kFingers; ++finger) {
      EXPECT_EQ(a[finger].normal, b[finger].normal);
      EXPECT_EQ(a[finger].tangential, b[finger].tangential);
      differing += a[finger].normal != c[finger].normal;
    }
  }
  EXPECT_GT(differing, 50);
}

}  // namespace
}  // namespace fastball::sim_bullet
