// A finger as a body: energy, equilibrium, the hand that carries it.
#include "model/finger_body.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "model/grasp.h"
#include "model/hand_support.h"
#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

HandMotion still() {
  HandMotion hand{};
  hand.X_WH.setIdentity();
  hand.v_WH.setZero();
  hand.w_WH.setZero();
  hand.a_WH.setZero();
  hand.dw_WH.setZero();
  return hand;
}

/// Kinetic energy [J] by the phalanges' own motion.
double kineticEnergy(const FingerBody& finger, const HandParameters& hand) {
  const double m = hand.finger_mass / 2, r2 = hand.finger_radius * hand.finger_radius;
  double energy = 0, turning = 0;
  for (int i = 0; i < 2; ++i) {
    const Segment& s = finger.phalanges()[i];
    const double length = (s.p_end - s.p_start).norm();
    turning += finger.qd()[i];
    const double inertia = m * (3 * r2 + length * length) / 12 + hand.joint_inertia;
    energy += m * finger.velocityAt(i, (s.p_start + s.p_end) / 2).squaredNorm() / 2 +
              inertia * turning * turning / 2;
  }
  return energy;
}

TEST(FingerBody, KeepsItsEnergyWithoutDrives) {
  const Hand hand(exampleHand());
  JointTargets swing;
  FingerBody finger(hand, kFingerB, HandVector::Constant(0.3), HandVector::Zero());
  for (int i = 0; i < 300; ++i) {  // set in motion by a push
    finger.push(1, finger.phalanges()[1].p_end, Eigen::Vector3d(0.5, -0.8, 0.3));
    finger.step(swing, still(), 0, 1e-5);
  }
  const double energy = kineticEnergy(finger, hand.parameters());
  ASSERT_GT(energy, 1e-5);
  for (int i = 0; i < 10000; ++i)
    finger.step(swing, still(), 0, 1e-5);
  EXPECT_NEAR(kineticEnergy(finger, hand.parameters()), energy, 2e-3 * energy);
}

TEST(FingerBody, HoldsTheForceThatItsTorquesAreFor) {
  const Hand hand(exampleHand());
  const GraspGeometry held = grasp(exampleBall(), hand, 6);
  JointTargets targets;
  targets.q = held.q;
  targets.tau = held.torques();
  targets.kp = exampleRelease().kp;
  targets.kd = exampleRelease().kd;
  for (const Finger which : {kFingerA, kThumb, kFingerB}) {
    FingerBody finger(hand, which, held.q, held.torques());
    const FingerGrasp& contact = held.fingers[which];
    for (int i = 0; i < 1000; ++i) {
      finger.push(1, contact.p_H, -contact.force * contact.n_H);
      finger.step(targets, still(), 0, 1e-4);
    }
    EXPECT_LT((finger.q() - held.q.segment<2>(Hand::proximalJoint(which))).norm(), 1e-9);
  }
}

TEST(FingerBody, AFreelyFallingHandCarriesItWithoutLoad) {
  const Hand hand(exampleHand());
  HandMotion falling = still();
  falling.a_WH = Eigen::Vector3d(0, 0, -9.81);
  FingerBody finger(hand, kThumb, HandVector::Constant(0.2), HandVector::Zero());
  for (int i = 0; i < 100; ++i)
    finger.step({}, falling, 9.81, 1e-4);
  EXPECT_LT(finger.qd().norm(), 1e-12);
  finger.step({}, still(), 9.81, 1e-4);
  EXPECT_GT(finger.qd().norm(), 1e-3) << "and one at rest sags";
}

TEST(FingerBody, PushesTheHandBackByItsOwnMomentum) {
  const Hand hand(exampleHand());
  FingerBody finger(hand, kThumb, HandVector::Constant(0.2), HandVector::Zero());
  JointTargets targets;
  targets.tau.setConstant(-0.5);
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  for (int i = 0; i < 2000; ++i) {
    finger.step(targets, still(), 0, 1e-6);
    given += 1e-6 * finger.reaction().force;
  }
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Segment& s = finger.phalanges()[i];
    momentum += 0.05 * finger.velocityAt(i, (s.p_start + s.p_end) / 2);
  }
  EXPECT_LT((given + momentum).norm(), 5e-3 * momentum.norm());
}

TEST(HandSupport, GivesWayAsItsSpringsSay) {
  ArmParameters parameters;
  parameters.dh = {
      {{0, -M_PI / 2, 0}, {0, M_PI / 2, 0}, {0.045, -M_PI / 2, 0.55}, {-0.045, M_PI / 2, 0}}};
  parameters.tool_plate_distance = 0.35;
  parameters.drive_inertia = {0.2, 0.2, 0.1, 0.1};
  for (RigidBody& link : parameters.links) {
    link.mass = 2;
    link.I_BCom = 0.01 * Eigen::Matrix3d::Identity();
  }
  const HandParameters hand = exampleHand();
  const Arm arm(parameters, hand.payload);
  const Vector4 q(0.3, 0.8, -0.4, 1.2);
  SupportVector kp, kd;
  kp << 8000, 8000, 2000, 5000, 500, 1500;
  kd << 250, 250, 22, 70, 3, 8;
  const HandSupport support = handSupport(arm, hand, q, {0.7, -0.2}, kp, kd);
  EXPECT_LT((support.M - support.M.transpose()).norm(), 1e-12);
  EXPECT_GT(support.M.determinant(), 0);
  // A wrist that is locked leaves the arm's own inertia.
  EXPECT_LT((support.M.topLeftCorner<4, 4>() - arm.massMatrix(q)).norm(), 1e-12);

  SupportedHand supported(&support);
  const HandWrench load{{1, -2, 3}, {0.1, 0.2, -0.3}};
  for (int i = 0; i < 20000; ++i)
    supported.step(load, Eigen::Matrix3d::Identity(), 1e-4);
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << load.force, load.moment;
  const SupportVector e = (support.J.transpose() * wrench).cwiseQuotient(kp);
  const Eigen::Vector3d moved = supported.moved(still()).X_WH.translation();
  EXPECT_LT((moved - (support.J * e).head<3>()).norm(), 1e-6 * moved.norm());
  EXPECT_LT(supported.moved(still()).v_WH.norm(), 1e-9);
}

}  // namespace
}  // namespace fastball::model
