// What the hand server knows of its throws by its fingers, against the simulator's truth.
#include "bench/felt_throws.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fastball::bench
