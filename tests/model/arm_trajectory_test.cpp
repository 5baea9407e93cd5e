#include "model/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

constexpr double kDt = 0.01;

/// Random samples that have nothing to do with one another: the hardest to go through.
std::vector<ArmMotion> randomSamples(int count) {
  std::mt19937 random(4);
  std::vector<ArmMotion> samples;
  for (int i = 0; i < count; ++i) {
    const ArmState state = randomState(&random);
    samples.push_back({state.q, state.qd, state.qdd});
  }
  return samples;
}

void expectNear(const ArmMotion& left, const ArmMotion& right, double q, double qd, double qdd) {
  EXPECT_LT((left.q - right.q).norm(), q);
  EXPECT_LT((left.qd - right.qd).norm(), qd);
  EXPECT_LT((left.qdd - right.qdd).norm(), qdd);
}

TEST(ArmTrajectory, GoesThroughItsSamplesFromBothSides) {
  const std::vector<ArmMotion> samples = randomSamples(10);
  const SampledTrajectory trajectory(kDt, samples);
  EXPECT_DOUBLE_EQ(trajectory.duration(), 9 * kDt);
  for (int i = 0; i < 10; ++i) {
    expectNear(trajectory.at(i * kDt), samples[i], 1e-12, 1e-9, 1e-6);
    if (i > 0) {
      expectNear(trajectory.at(i * kDt - 1e-12), samples[i], 1e-8, 1e-5, 1e-2);
    }
  }
}

TEST(ArmTrajectory, SpeedAndAccelerationAreTheDerivatives) {
  const SampledTrajectory trajectory(kDt, randomSamples(10));
  const double step = 1e-7;
  for (int i = 0; i < 90; ++i) {
    const double t = (i + 0.37) * 0.1 * kDt;
    const ArmMotion before = trajectory.at(t - step);
    const ArmMotion here = trajectory.at(t);
    const ArmMotion after = trajectory.at(t + step);
    EXPECT_LT(((after.q - before.q) / (2 * step) - here.qd).norm(), 1e-6 * (1 + here.qd.norm()));
    EXPECT_LT(((after.qd - before.qd) / (2 * step) - here.qdd).norm(),
              1e-6 * (1 + here.qdd.norm()));
  }
}

TEST(ArmTrajectory, ReproducesAQuinticExactly) {
  const auto quintic = [](double t) {
    ArmMotion motion;
    for (int i = 0; i < kArmJoints; ++i) {
      const double c = 1 + i;
      motion.q[i] = c * (1 + t - 2 * std::pow(t, 3) + 3 * std::pow(t, 5));
      motion.qd[i] = c * (1 - 6 * t * t + 15 * std::pow(t, 4));
      motion.qdd[i] = c * (-12 * t + 60 * std::pow(t, 3));
    }
    return motion;
  };
  const SampledTrajectory trajectory(0.5, {quintic(0), quintic(0.5), quintic(1)});
  for (int i = 0; i <= 32; ++i) {
    const double t = i / 32.0;
    expectNear(trajectory.at(t), quintic(t), 1e-13, 1e-12, 1e-11);
  }
}

TEST(ArmTrajectory, RestsOutsideItsTime) {
  const std::vector<ArmMotion> samples = randomSamples(3);
  const SampledTrajectory trajectory(kDt, samples);
  for (const double t : {-1e-9, -1.0, -std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN()}) {
    expectNear(trajectory.at(t), {samples.front().q}, 1e-15, 1e-15, 1e-15);
  }
  for (const double t : {2 * kDt + 1e-9, 1.0, std::numeric_limits<double>::infinity()}) {
    expectNear(trajectory.at(t), {samples.back().q}, 1e-15, 1e-15, 1e-15);
  }
}

TEST(ArmTrajectory, RejectsWhatIsNoTrajectory) {
  const std::vector<ArmMotion> two(2);
  EXPECT_THROW(SampledTrajectory(0, two), std::invalid_argument);
  EXPECT_THROW(SampledTrajectory(-1, two), std::invalid_argument);
  EXPECT_THROW(SampledTrajectory(std::numeric_limits<double>::quiet_NaN(), two),
               std::invalid_argument);
  EXPECT_THROW(SampledTrajectory(kDt, std::vector<ArmMotion>(1)), std::invalid_argument);
  EXPECT_EQ(SampledTrajectory().duration(), 0);
}

}  // namespace
}  // namespace fastball::model
