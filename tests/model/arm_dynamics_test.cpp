#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/model/arm_states.h"

namespace fastball::model {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 1e-6;  // of finite differences

/// The bodies of the arm one by one: pose of each body's frame, links first, the payload last.
std::vector<std::pair<RigidBody, Eigen::Isometry3d>> bodies(const Arm& arm, const Vector4& q) {
  std::vector<std::pair<RigidBody, Eigen::Isometry3d>> result;
  result.reserve(kArmJoints + 1);
  for (int i = 0; i < kArmJoints; ++i) {
    result.emplace_back(arm.parameters().links[i], arm.X_WLink(q, i + 1));
  }
  result.emplace_back(defaultExperiment().hand.payload, arm.X_WT(q));
  return result;
}

double potentialEnergy(const Arm& arm, const Vector4& q) {
  double energy = 0;
  for (const auto& [body, X_WBody] : bodies(arm, q)) {
    energy += body.mass * arm.parameters().gravity * (X_WBody * body.p_BCom).z();
  }
  return energy;
}

/// By the definition: each body's velocities from finite differences of its pose, and the rotors'.
double kineticEnergy(const Arm& arm, const Vector4& q, const Vector4& qd) {
  const auto before = bodies(arm, q - kStep * qd);
  const auto after = bodies(arm, q + kStep * qd);
  double energy = 0.5 * qd.dot(arm.parameters().drive_inertia.cwiseProduct(qd));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const RigidBody& body = before[i].first;
    const Vector3d v =
        (after[i].second * body.p_BCom - before[i].second * body.p_BCom) / (2 * kStep);
    const Eigen::Matrix3d turn =
        before[i].second.linear().transpose() * after[i].second.linear();  // in the body's frame
    const Vector3d w =
        Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) /
        (4 * kStep);
    energy += 0.5 * body.mass * v.squaredNorm() + 0.5 * w.dot(body.I_BCom * w);
  }
  return energy;
}

double energy(const Arm& arm, const ArmState& state) {
  return 0.5 * state.qd.dot(arm.massMatrix(state.q) * state.qd) + potentialEnergy(arm, state.q);
}

TEST(ArmDynamics, MassMatrixIsSymmetricAndPositiveDefinite) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Matrix4 M = arm.massMatrix(state.q);
    EXPECT_EQ(M, M.transpose());
    const Vector4 eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix4>(M).eigenvalues();
    // Nothing is lighter than the lightest drive.
    EXPECT_GT(eigenvalues[0], arm.parameters().drive_inertia.minCoeff());
  }
}

TEST(ArmDynamics, MassMatrixGivesTheKineticEnergyOfTheBodies) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const double expected = kineticEnergy(arm, state.q, state.qd);
    EXPECT_NEAR(0.5 * state.qd.dot(arm.massMatrix(state.q) * state.qd), expected,
                1e-8 * (1 + expected));
  }
}

TEST(ArmDynamics, MassMatrixColumnIsTheTorqueOfAUnitAcceleration) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Matrix4 M = arm.massMatrix(state.q);
    for (int i = 0; i < kArmJoints; ++i) {
      const Vector4 tau = arm.inverseDynamics(state.q, Vector4::Zero(), Vector4::Unit(i));
      EXPECT_LT((M.col(i) - (tau - arm.gravityTorque(state.q))).norm(), 1e-13);
    }
  }
}

TEST(ArmDynamics, GravityTorqueIsTheSlopeOfThePotentialEnergy) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Vector4 gravity = arm.gravityTorque(state.q);
    for (int i = 0; i < kArmJoints; ++i) {
      const Vector4 step = kStep * Vector4::Unit(i);
      const double slope =
          (potentialEnergy(arm, state.q + step) - potentialEnergy(arm, state.q - step)) /
          (2 * kStep);
      EXPECT_NEAR(gravity[i], slope, 1e-7);
    }
  }
}

TEST(ArmDynamics, ThePowerOfTheTorquesIsTheGainOfEnergy) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const double gain =
        (energy(arm, later(state, kStep)) - energy(arm, later(state, -kStep))) / (2 * kStep);
    const double power = state.qd.dot(arm.inverseDynamics(state.q, state.qd, state.qdd));
    EXPECT_NEAR(power, gain, 1e-6 * (1 + std::abs(power)));
  }
}

TEST(ArmDynamics, ForwardDynamicsUndoesInverseDynamics) {
  const Arm arm = loadedArm();
  for (const ArmState& state : testStates()) {
    const Vector4 tau = arm.inverseDynamics(state.q, state.qd, state.qdd);
    const Vector4 qdd = arm.forwardDynamics(state.q, state.qd, tau);
    EXPECT_LT((qdd - state.qdd).norm(), 1e-11 * (1 + state.qdd.norm()));
  }
}

TEST(ArmDynamics, FrictionOpposesMotionAndIsCoulombPlusViscousAtSpeed) {
  const Arm arm = loadedArm();
  const ArmParameters& parameters = arm.parameters();
  EXPECT_EQ(arm.frictionTorque(Vector4::Zero()), Vector4::Zero());
  for (const ArmState& state : testStates()) {
    const Vector4 friction = arm.frictionTorque(state.qd);
    EXPECT_EQ(friction, -arm.frictionTorque(-state.qd));
    EXPECT_GE(friction.cwiseProduct(state.qd).minCoeff(), 0);
  }
  const Vector4 fast = Vector4::Constant(0.5);
  const Vector4 expected = parameters.coulomb_friction + 0.5 * parameters.viscous_friction;
  EXPECT_TRUE(arm.frictionTorque(fast).isApprox(expected, 1e-12));
}

}  // namespace
}  // namespace fastball::model
