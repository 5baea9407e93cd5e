#include <gtest/gtest.h>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const Vector3d kPoint(0.02, -0.03, 0.15);  // of the tool frame [m]
constexpr double kStep = 1e-6;             // of finite differences

TEST(ArmKinematics, ToolPoseIsTheClosedFormOfTheArm) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Vector4& q = state.q;
    const AngleAxisd forearm(q[3], Vector3d::UnitY());
    const Eigen::Quaterniond upper_arm = AngleAxisd(q[0], Vector3d::UnitZ()) *
                                         AngleAxisd(q[1], Vector3d::UnitY()) *
                                         AngleAxisd(q[2], Vector3d::UnitZ());
    const Vector3d p_WT =
        upper_arm * (Vector3d(0.045, 0, 0.55) + forearm * Vector3d(-0.045, 0, 0.35));
    const Eigen::Isometry3d X_WT = arm.X_WT(q);
    EXPECT_LT((X_WT.translation() - p_WT).norm(), 1e-14);
    EXPECT_LT((X_WT.linear() - (upper_arm * forearm).toRotationMatrix()).norm(), 1e-14);
    EXPECT_LT((arm.p_WPoint(q, kPoint) - X_WT * kPoint).norm(), 1e-15);
  }
}

TEST(ArmKinematics, AtZeroTheArmPointsStraightUp) {
  const Arm arm = loadedArm();
  const Vector4 zero = Vector4::Zero();
  EXPECT_LT((arm.X_WT(zero).translation() - Vector3d(0, 0, 0.9)).norm(), 1e-15);
  EXPECT_LT((arm.X_WLink(zero, 3).translation() - Vector3d(0.045, 0, 0.55)).norm(), 1e-15);
  EXPECT_LT((arm.X_WLink(zero, 3).linear().col(2) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((arm.X_WLink(zero, 4).translation() - Vector3d(0, 0, 0.55)).norm(), 1e-15);
}

TEST(ArmKinematics, PointJacobianIsTheDerivativeOfThePoint) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Jacobian J = arm.pointJacobian(state.q, kPoint);
    for (int i = 0; i < kArmJoints; ++i) {
      const Vector4 step = kStep * Vector4::Unit(i);
      const Vector3d difference =
          (arm.p_WPoint(state.q + step, kPoint) - arm.p_WPoint(state.q - step, kPoint)) /
          (2 * kStep);
      EXPECT_LT((J.col(i) - difference).norm(), 1e-9);
    }
  }
}

TEST(ArmKinematics, RotationJacobianIsTheDerivativeOfTheOrientation) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Jacobian J = arm.rotationJacobian(state.q);
    for (int i = 0; i < kArmJoints; ++i) {
      const Vector4 step = kStep * Vector4::Unit(i);
      const Eigen::Matrix3d turn =
          arm.X_WT(state.q + step).linear() * arm.X_WT(state.q - step).linear().transpose();
      const Vector3d difference =
          Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) /
          (4 * kStep);
      EXPECT_LT((J.col(i) - difference).norm(), 1e-9);
    }
  }
}

TEST(ArmKinematics, PointAccelerationIsTheDerivativeOfThePointsVelocity) {
  const Arm arm = loadedArm();
  const auto velocity = [&arm](const ArmState& state) -> Vector3d {
    return arm.pointJacobian(state.q, kPoint) * state.qd;
  };
  for (const ArmState& state : testStates()) {
    const Vector3d difference =
        (velocity(later(state, kStep)) - velocity(later(state, -kStep))) / (2 * kStep);
    const Vector3d a = arm.pointAcceleration(state.q, state.qd, state.qdd, kPoint);
    EXPECT_LT((a - difference).norm(), 1e-8 * (1 + a.norm()));
  }
}

}  // namespace
}  // namespace fastball::model
