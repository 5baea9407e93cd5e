// What the hand server knows of its throws by its fingers, against the simulator's truth.
#include "bench/felt_throws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace fastball::bench {
namespace {

const std::string kExperimentFile = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
constexpr int kThrows = 100;  // of each mode

/// Throws with another stiffness, friction, offset, mass and sensor noise each.
void feelDepartures(const std::string& strategy, model::ReleaseMode mode) {
  const FeltThrows throws(kExperimentFile, strategy);
  EXPECT_EQ(throws.releaseMode(), mode);
  const DepartureError error = departureError(throws, unknownBall(), kThrows);
  EXPECT_EQ(error.missed, 0);
  EXPECT_LT(error.felt, 0.5e-3) << "[s], root mean square";
  EXPECT_LT(error.felt, error.last_touch);
}

TEST(FeltThrows, ADepartureIsFeltWithinHalfAMillisecondWhenTheThumbOpensAbruptly) {
  feelDepartures("paper", model::ReleaseMode::kAbrupt);
}

TEST(FeltThrows, ADepartureIsFeltWithinHalfAMillisecondWhenTheFingersRetreat) {
  feelDepartures("robust", model::ReleaseMode::kSyncRetreat);
}

TEST(FeltThrows, TheHandLearnsItsFingersDeadTime) {
  const FeltThrows throws(kExperimentFile, "paper");
  sim_bullet::Uncertainty uncertainty = unknownBall();
  uncertainty.setUniform(sim_bullet::Uncertainty::kSetUp, sim_bullet::Error::kOpeningDelay, 0.004,
                         0.004);
  uncertainty.of(sim_bullet::Uncertainty::kThrow, sim_bullet::Error::kOpeningDelay).distribution = {
      sim_bullet::Distribution::Shape::kHalfNormal, 0.001, 0};
  hand_server::HandController hand = throws.makeHand();
  double planned = 0, predicted = 0;
  for (int seed = 1; seed <= 25; ++seed) {
    const FeltThrow thrown = throws.run(hand, uncertainty, seed);
    if (seed <= 5)  // it has little to go by
      continue;
    planned += std::pow(thrown.planned_departure - thrown.departure, 2);
    predicted += std::pow(thrown.predicted_departure - thrown.departure, 2);
  }
  EXPECT_LT(predicted, 0.5 * planned) << "[s^2]";
}

TEST(FeltThrows, TheHandFeelsHowLateEachFingerObeys) {
  const FeltThrows throws(kExperimentFile, "tactile");
  sim_bullet::Uncertainty uncertainty = unknownBall();
  using sim_bullet::Error;
  uncertainty.setUniform(sim_bullet::Uncertainty::kThrow, Error::kOpeningDelay, 0, 0.02);
  uncertainty.setUniform(sim_bullet::Uncertainty::kThrow, Error::kFingerDelay, 0, 0.005);
  hand_server::HandController hand = throws.makeHand();
  for (int seed = 1; seed <= 40; ++seed) {
    const FeltThrow thrown = throws.run(hand, uncertainty, seed);
    ASSERT_TRUE(thrown.felt_dead_times) << seed;
    for (std::size_t i = 0; i < thrown.errors.finger_delay.size(); ++i)
      EXPECT_NEAR((*thrown.felt_dead_times)[i], thrown.errors.finger_delay[i], 0.6e-3)
          << "seed " << seed << ", finger " << i;
  }
}

TEST(FeltThrows, TheFingersFeelHowTheBallLiesAndHowHardItIs) {
  const FeltThrows throws(kExperimentFile, "robust");
  hand_server::HandController hand = throws.makeHand();
  for (int seed = 1; seed <= 40; ++seed) {
    const FeltThrow thrown = throws.run(hand, unknownBall(), seed);
    ASSERT_TRUE(thrown.felt_lay) << seed;
    const hand_server::GripEstimate &felt = *thrown.felt_lay, &lay = thrown.lay;
    EXPECT_NEAR(felt.grip_force, lay.grip_force, 0.02 * lay.grip_force) << seed;
    EXPECT_LT((felt.p_HBall - lay.p_HBall).head<2>().norm(), 0.05e-3) << "[m], seed " << seed;
    EXPECT_NEAR(felt.p_HBall.z(), lay.p_HBall.z(), 0.5e-3) << "[m], seed " << seed;
    EXPECT_NEAR(felt.youngs_modulus, lay.youngs_modulus, 0.02 * lay.youngs_modulus) << seed;
  }
}

}  // namespace
}  // namespace fastball::bench
