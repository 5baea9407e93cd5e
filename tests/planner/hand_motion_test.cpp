// The hand frame's motion against finite differences of its pose.

#include "planner/hand_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/planner/default_throw.h"

namespace fastball::planner {
namespace {

/// A polynomial motion through a random pose.
model::ArmMotion motionAt(const std::array<Eigen::Vector4d, 4>& c, double t) {
  return {c[0] + t * (c[1] + t * (0.5 * c[2] + t * c[3] / 6)), c[1] + t * (c[2] + t * c[3] / 2),
          c[2] + t * c[3]};
}

TEST(HandMotion, IsTheDerivativeOfThePose) {
  const DefaultThrow example;
  const model::Arm arm(example.config.arm, example.config.hand.payload);
  const model::Hand hand(example.config.hand);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> number(-1, 1);
  constexpr double kH = 1e-4;
  constexpr WristAngles kWrist{0.7, -0.3};
  for (int i = 0; i < 20; ++i) {
    std::array<Eigen::Vector4d, 4> c;
    for (auto& row : c)
      row = Eigen::Vector4d::NullaryExpr([&] { return 3 * number(engine); });
    const auto at = [&](double t) { return handMotion(arm, hand, kWrist, motionAt(c, t)); };
    const model::HandMotion before = at(-kH), now = at(0), after = at(kH);
    const auto derivative = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return Eigen::Vector3d((b - a) / (2 * kH));
    };
    EXPECT_LT((derivative(before.X_WH.translation(), after.X_WH.translation()) - now.v_WH).norm(),
              1e-4);
    EXPECT_LT((derivative(before.v_WH, after.v_WH) - now.a_WH).norm(), 1e-3);
    EXPECT_LT((derivative(before.w_WH, after.w_WH) - now.dw_WH).norm(), 1e-3);
    const Eigen::AngleAxisd turn(after.X_WH.linear() * before.X_WH.linear().transpose());
    EXPECT_LT((turn.angle() * turn.axis() / (2 * kH) - now.w_WH).norm(), 1e-4);
  }
}

TEST(ThrowDirection, TurnsTheHandAlongTheBallsPath) {
  const DefaultThrow example;
  const model::Arm arm(example.config.arm, example.config.hand.payload);
  const model::Hand hand(example.config.hand);
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    model::ArmMotion motion;
    motion.q = Eigen::Vector4d::NullaryExpr([&] { return 1.5 * number(engine); });
    motion.qd = Eigen::Vector4d::NullaryExpr([&] { return 4 * number(engine); });
    const ThrowDirection direction = throwDirection(arm, hand, motion);
    const model::HandMotion moving = handMotion(arm, hand, direction.wrist, motion);
    const Eigen::Vector3d arm_W = moving.X_WH.linear() * example.config.hand.p_HBall;
    const Eigen::Vector3d v_H =
        moving.X_WH.linear().transpose() * (moving.v_WH + moving.w_WH.cross(arm_W));
    EXPECT_NEAR(v_H.x(), 0, 1e-9);
    EXPECT_NEAR(v_H.z(), 0, 1e-9) << "Eq. (25)";
    EXPECT_NEAR(v_H.y(), direction.speed, 1e-9);
    EXPECT_LT((moving.X_WH.linear().col(1) - direction.y_WH).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace fastball::planner
