// Limits that make no sense lead to a sentence, not to a crash or a plan that breaks them.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/planner/default_throw.h"

namespace fastball::planner {
namespace {

struct BadLimit {
  const char* name;
  std::function<void(PlannerConfig&)> spoil;
};

class BadLimits : public testing::TestWithParam<BadLimit> {};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Of,
    BadLimits,
    testing::Values(
        BadLimit{"SpeedNan", [](PlannerConfig& c) { c.arm.qd_max[2] = kNan; }},
        BadLimit{"SpeedZero", [](PlannerConfig& c) { c.arm.qd_max.setZero(); }},
        BadLimit{"SpeedTiny", [](PlannerConfig& c) { c.arm.qd_max.setConstant(1e-9); }},
        BadLimit{"TorqueNan", [](PlannerConfig& c) { c.arm.tau_max[0] = kNan; }},
        BadLimit{"TorqueTiny", [](PlannerConfig& c) { c.arm.tau_max *= 1e-6; }},
        BadLimit{"RangeNan", [](PlannerConfig& c) { c.arm.q_max[3] = kNan; }},
        BadLimit{"RangeEmpty", [](PlannerConfig& c) { c.arm.q_max = c.arm.q_min; }},
        BadLimit{"BallWithoutMass", [](PlannerConfig& c) { c.ball.mass = 0; }},
        BadLimit{"BallMassNan", [](PlannerConfig& c) { c.ball.mass = kNan; }},
        BadLimit{"GravityInfinite", [](PlannerConfig& c) { c.arm.gravity = kInfinity; }},
        BadLimit{"FingersTooShort", [](PlannerConfig& c) { c.hand.proximal_length = 0.01; }},
        BadLimit{"GripTooStrong", [](PlannerConfig& c) { c.grip_force = 500; }},
        BadLimit{"ElbowMarginNan", [](PlannerConfig& c) { c.swing.elbow_margin = kNan; }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(BadLimits, AreRefusedWithASentence) {
  DefaultThrow example;
  GetParam().spoil(example.config);
  const PlanResult result = Planner(example.config).plan(example.request());
  const Refusal* refusal = std::get_if<Refusal>(&result);
  ASSERT_NE(refusal, nullptr);
  EXPECT_FALSE(refusal->sentence.empty());
}

}  // namespace
}  // namespace fastball::planner
