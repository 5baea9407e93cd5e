#include <gtest/gtest.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "bench/kdl_arm.h"
#include "tests/model/arm_states.h"

// The arm against an independent library: Orocos KDL, with the payload as a body of its own.
namespace fastball::model {
namespace {

using bench::kdlArm;
using bench::toKdl;

class ArmAgainstKdl : public testing::Test {
 protected:
  const KDL::Chain chain_ = kdlArm(defaultExperiment().arm, defaultExperiment().hand.payload);
  const KDL::Vector gravity_{0, 0, -defaultExperiment().arm.gravity};
  const Arm arm_ = loadedArm();
  std::mt19937 random_{3};
  static constexpr int kStates = 1000;
};

TEST_F(ArmAgainstKdl, ToolPose) {
  KDL::ChainFkSolverPos_recursive solver(chain_);
  for (int i = 0; i < kStates; ++i) {
    const ArmState state = randomState(&random_);
    KDL::Frame frame;
    ASSERT_EQ(solver.JntToCart(toKdl(state.q), frame), 0);
    const Eigen::Isometry3d X_WT = arm_.X_WT(state.q);
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(X_WT.translation()[row], frame.p[row], 1e-14);
      for (int col = 0; col < 3; ++col) {
        EXPECT_NEAR(X_WT.linear()(row, col), frame.M(row, col), 1e-14);
      }
    }
  }
}

TEST_F(ArmAgainstKdl, InverseDynamics) {
  KDL::ChainIdSolver_RNE solver(chain_, gravity_);
  const KDL::Wrenches none(chain_.getNrOfSegments(), KDL::Wrench::Zero());
  double largest = 0;
  for (int i = 0; i < kStates; ++i) {
    const ArmState state = randomState(&random_);
    KDL::JntArray torques(kArmJoints);
    ASSERT_EQ(solver.CartToJnt(toKdl(state.q), toKdl(state.qd), toKdl(state.qdd), none, torques),
              0);
    const Vector4 tau = arm_.inverseDynamics(state.q, state.qd, state.qdd);
    const double difference = (tau - Vector4(torques.data)).norm() / (1 + tau.norm());
    EXPECT_LT(difference, 1e-9);
    largest = std::max(largest, difference);
  }
  RecordProperty("largest_relative_difference", std::to_string(largest * 1e15) + "e-15");
}

TEST_F(ArmAgainstKdl, MassMatrixAndGravity) {
  KDL::ChainDynParam solver(chain_, gravity_);
  double largest = 0;
  for (int i = 0; i < kStates; ++i) {
    const ArmState state = randomState(&random_);
    KDL::JntSpaceInertiaMatrix mass(kArmJoints);
    KDL::JntArray gravity(kArmJoints);
    ASSERT_EQ(solver.JntToMass(toKdl(state.q), mass), 0);
    ASSERT_EQ(solver.JntToGravity(toKdl(state.q), gravity), 0);
    const Matrix4 M = arm_.massMatrix(state.q);
    const double difference = (M - Matrix4(mass.data)).norm() / M.norm();
    EXPECT_LT(difference, 1e-9);
    EXPECT_LT((arm_.gravityTorque(state.q) - Vector4(gravity.data)).norm(), 1e-9);
    largest = std::max(largest, difference);
  }
  RecordProperty("largest_relative_difference", std::to_string(largest * 1e15) + "e-15");
}

}  // namespace
}  // namespace fastball::model
