#include "sim_bullet/arm_hand.h"

#include <gtest/gtest.h>

#include "model/arm.h"
#include "sim_bullet/world.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector4d;
using model::HandVector;

/// Joint accelerations of the simulated arm: what one step makes of the velocities.
JointVectors accelerations(ArmHand& arm_hand,
                           const JointVectors& q,
                           const JointVectors& qd,
                           const JointVectors& tau) {
  constexpr double kStep = 1e-4;
  World world(arm_hand, experiment().ball, experiment().target, simulation().net,
              simulation().floor, experiment().arm.gravity);
  arm_hand.setState(q, qd);
  arm_hand.addTorques(tau);
  world.step(kStep);
  const JointVectors after = arm_hand.qd();
  return {(after.arm - qd.arm) / kStep, (after.hand - qd.hand) / kStep};
}

HandVector somePosture(std::mt19937& engine) {
  return randomVector<HandVector>(engine, HandVector::Constant(0.8));
}

class RigidHand : public testing::TestWithParam<bool> {};

// With its hand frozen the simulated arm is the arm of model/, moving under the same torques: with the drive inertia of
// the motors (which Bullet does not know) and without.
TEST_P(RigidHand, AcceleratesAsTheModel) {
  model::ArmParameters arm = experiment().arm;
  if (!GetParam())
    arm.drive_inertia.setZero();
  model::HandParameters hand = experiment().hand;
  hand.joint_inertia = hand.wrist_inertia = 0;  // of frozen joints: none in the model's payload
  std::mt19937 engine(1);
  for (int k = 0; k < 200; ++k) {
    const HandVector q_hand = somePosture(engine);
    ArmHand arm_hand(arm, hand, q_hand, ArmHand::Fingers::kFrozen);
    const model::Arm oracle(arm, frozenHand(arm_hand.tree(), arm.tool_plate_distance, q_hand));
    const double size = k == 0 ? 0 : k < 10 ? 1e-9 : 1;  // at zero, near it, and anywhere
    const Vector4d q = randomVector<Vector4d>(engine, size * arm.q_max);
    const Vector4d qd = randomVector<Vector4d>(engine, size * Vector4d::Constant(8));
    const Vector4d tau = randomVector<Vector4d>(engine, size * arm.tau_max);
    const Vector4d expected = oracle.forwardDynamics(q, qd, tau);
    const Vector4d got = accelerations(arm_hand, {q, q_hand}, {qd, {}}, {tau, {}}).arm;
    EXPECT_LT((got - expected).norm(), 1e-9 * (1 + expected.norm())) << "state " << k;
    EXPECT_LT((oracle.inverseDynamics(q, qd, got) - tau).norm(), 1e-9 * (1 + expected.norm()));
  }
}
INSTANTIATE_TEST_SUITE_P(DriveInertia, RigidHand, testing::Values(false, true));

TEST(ArmHand, HasTheKinematicsOfTheModel) {
  const model::Arm arm(experiment().arm);
  const model::Hand hand(experiment().hand);
  std::mt19937 engine(2);
  ArmHand arm_hand(experiment().arm, experiment().hand, HandVector::Zero());
  for (int k = 0; k < 100; ++k) {
    const JointVectors q{randomVector<Vector4d>(engine, experiment().arm.q_max),
                         somePosture(engine)};
    arm_hand.setState(q, {});
    arm_hand.updateKinematics();
    const Eigen::Isometry3d X_WH =
        arm.X_WT(q.arm) * hand.X_TH(q.hand[model::kWristRoll], q.hand[model::kWristFlexion]);
    EXPECT_LT((arm_hand.motion(kHandLink).X_WF.matrix() - X_WH.matrix()).norm(), 1e-12);
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      const auto phalanges = hand.phalanges(finger, q.hand);
      const int proximal = model::kArmJoints + model::Hand::proximalJoint(finger);
      for (int i = 0; i < 2; ++i) {
        const Eigen::Isometry3d& X_WF = arm_hand.motion(proximal + i).X_WF;
        const double length = (phalanges[i].p_end - phalanges[i].p_start).norm();
        EXPECT_LT((X_WF.translation() - X_WH * phalanges[i].p_start).norm(), 1e-12);
        EXPECT_LT((X_WF * Eigen::Vector3d(0, 0, length) - X_WH * phalanges[i].p_end).norm(), 1e-12);
      }
    }
  }
}

TEST(ArmHand, PointsMoveAtTheSpeedOfTheirLink) {
  std::mt19937 engine(3);
  ArmHand arm_hand(experiment().arm, experiment().hand, HandVector::Zero());
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 20; ++k) {
    const JointVectors q{randomVector<Vector4d>(engine, experiment().arm.q_max),
                         somePosture(engine)};
    const JointVectors qd{randomVector<Vector4d>(engine, Vector4d::Constant(5)),
                          randomVector<HandVector>(engine, HandVector::Constant(20))};
    std::array<std::array<Eigen::Vector3d, kJoints>, 3> p_W;
    const Eigen::Vector3d p_F(0.01, -0.02, 0.03);
    for (const int side : {-1, 1, 0}) {
      arm_hand.setState({q.arm + side * kStep * qd.arm, q.hand + side * kStep * qd.hand}, qd);
      arm_hand.updateKinematics();
      for (int i = 0; i < kJoints; ++i)
        p_W[side + 1][i] = arm_hand.motion(i).X_WF * p_F;
    }
    for (int i = 0; i < kJoints; ++i) {
      const Eigen::Vector3d difference = (p_W[2][i] - p_W[0][i]) / (2 * kStep);
      EXPECT_LT((arm_hand.motion(i).velocityAt(p_W[1][i]) - difference).norm(), 1e-7)
          << "link " << i;
    }
  }
}

// Nothing drives, nothing brakes: 14 joints swing freely for a second and the energy stays, drives included. Half the step
// leaves half the error.
TEST(ArmHand, KeepsItsEnergyInAFreeSwing) {
  const auto energyError = [](double step) {
    std::mt19937 engine(4);
    ArmHand arm_hand(experiment().arm, experiment().hand, HandVector::Zero());
    World world(arm_hand, experiment().ball, experiment().target, simulation().net,
                simulation().floor, experiment().arm.gravity);
    arm_hand.setState({{0.3, 1.2, 0.4, 1.0}, somePosture(engine)},
                      {{1, -1, 2, 1}, randomVector<HandVector>(engine, HandVector::Constant(3))});
    const double energy = arm_hand.energy(experiment().arm.gravity);
    double error = 0;
    for (double t = 0; t < 0.5; t += step) {
      world.step(step);
      error = std::max(error, std::abs(arm_hand.energy(experiment().arm.gravity) - energy));
    }
    return error;
  };
  const double coarse = energyError(1e-4);
  EXPECT_LT(coarse, 0.02);  // [J], of the 10 J that swing
  EXPECT_NEAR(energyError(0.5e-4) / coarse, 0.5, 0.1);
}

}  // namespace
}  // namespace fastball::sim_bullet
