#include <gtest/gtest.h>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

// Each limit in turn, then joints 2 and 3 with half of theirs each, which together are at the
// differential's limit.
TEST(ArmLimits, RatioIsOneAtALimit) {
  const Arm arm = loadedArm();
  const Vector4& qd_max = arm.parameters().qd_max;
  const Vector4& tau_max = arm.parameters().tau_max;
  EXPECT_EQ(arm.speedRatio(Vector4::Zero()), 0);
  for (int i = 0; i < kArmJoints; ++i) {
    EXPECT_EQ(arm.speedRatio(qd_max[i] * Vector4::Unit(i)), 1);
    EXPECT_EQ(arm.torqueRatio(-tau_max[i] * Vector4::Unit(i)), 1);
  }
  const Vector4 half(0, 0.5, -0.5, 0);
  EXPECT_DOUBLE_EQ(arm.speedRatio(half.cwiseProduct(qd_max)), 1);
  EXPECT_DOUBLE_EQ(arm.torqueRatio(half.cwiseProduct(tau_max)), 1);
  EXPECT_DOUBLE_EQ(arm.speedRatio(qd_max), 2);
}

TEST(ArmLimits, WithoutADifferentialEachJointHasItsOwnLimit) {
  ArmParameters parameters = defaultExperiment().arm;
  parameters.differential = false;
  const Arm arm(parameters);
  EXPECT_EQ(arm.speedRatio(parameters.qd_max), 1);
  EXPECT_EQ(arm.torqueRatio(-parameters.tau_max), 1);
  EXPECT_EQ(arm.clipTorque(2 * parameters.tau_max), parameters.tau_max);
}

TEST(ArmLimits, ClippedTorqueIsWithinTheLimitsAndUnchangedInside) {
  const Arm arm = loadedArm();
  std::mt19937 random(2);
  const Vector4 most = 3 * arm.parameters().tau_max;
  for (int i = 0; i < 1000; ++i) {
    const Vector4 tau = randomVector(&random, -most, most);
    const Vector4 clipped = arm.clipTorque(tau);
    EXPECT_LE(arm.torqueRatio(clipped), 1 + 1e-15);
    EXPECT_EQ(clipped[0], std::clamp(tau[0], -most[0] / 3, most[0] / 3));
    EXPECT_EQ(clipped[3], std::clamp(tau[3], -most[3] / 3, most[3] / 3));
    // The pair keeps its direction, and is shrunk no more than it must be.
    EXPECT_NEAR(clipped[1] * tau[2], clipped[2] * tau[1], 1e-9);
    EXPECT_GE(clipped[1] * tau[1], 0);
    const Vector4 pair(0, tau[1], tau[2], 0);
    EXPECT_NEAR(arm.torqueRatio(Vector4(0, clipped[1], clipped[2], 0)),
                std::min(1.0, arm.torqueRatio(pair)), 1e-15);
    const Vector4 inside = tau / (1.001 * std::max(1.0, arm.torqueRatio(tau)));
    EXPECT_EQ(arm.clipTorque(inside), inside);
  }
  EXPECT_EQ(arm.clipTorque(Vector4::Zero()), Vector4::Zero());
}

}  // namespace
}  // namespace fastball::model
