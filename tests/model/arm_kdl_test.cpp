#include <gtest/gtest.h>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "tests/model/arm_states.h"

// The arm against an independent library: Orocos KDL, with the payload as a body of its own.
namespace fastball::model {
namespace {

KDL::RigidBodyInertia toKdl(const RigidBody& body) {
  const Eigen::Matrix3d& I = body.I_BCom;
  return KDL::RigidBodyInertia(
      body.mass, KDL::Vector(body.p_BCom.x(), body.p_BCom.y(), body.p_BCom.z()),
      KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
}

KDL::Chain kdlArm(const ArmParameters& parameters, const RigidBody& payload) {
  KDL::Chain chain;
  for (int i = 0; i < kArmJoints; ++i) {
    const DhRow& row = parameters.dh[i];
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ, 1, 0, parameters.drive_inertia[i]),
                                  KDL::Frame::DH(row.a, row.alpha, row.d, 0),
                                  toKdl(parameters.links[i])));
  }
  const KDL::Frame tool(KDL::Vector(0, 0, parameters.tool_plate_distance));
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), tool, toKdl(payload)));
  return chain;
}

KDL::JntArray toKdl(const Vector4& value) {
  KDL::JntArray array(kArmJoints);
  array.data = value;
  return array;
}

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
