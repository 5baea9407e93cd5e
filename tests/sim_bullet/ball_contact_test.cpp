#include "sim_bullet/ball_contact.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <gtest/gtest.h>

#include "model/contact.h"
#include "sim_bullet/bullet_eigen.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 1e-4;

/// The hand closed around the nominal ball by distances of its distal phalanges' axes from z, arm at rest.
class BallContact : public testing::Test {
 protected:
  void close(const std::array<double, model::kFingers>& distances) {
    const model::Hand hand(experiment().hand);
    arm_hand_.setState({experiment().q_rest, hand.posture(0, 0, distances)}, {});
    arm_hand_.updateKinematics();
    const Eigen::Isometry3d& X_WH = arm_hand_.motion(kHandLink).X_WF;
    ball_.p_WBall = X_WH * experiment().hand.p_HBall;
    ball_.R_WBall = X_WH.linear();
  }
  Vector3d inHand(const Vector3d& v_W) const {
    return arm_hand_.motion(kHandLink).X_WF.linear().transpose() * v_W;
  }
  /// Force of everything on the links, and its moment about the world's origin.
  Wrench onLinks() {
    Wrench sum;
    for (int i = 0; i < kJoints; ++i) {
      const Vector3d f_W = toEigen(arm_hand_.body().getLinkForce(i));
      const Vector3d p_WCom = arm_hand_.motion(i).X_WF * arm_hand_.tree()[i].body.p_BCom;
      sum.force += f_W;
      sum.moment += toEigen(arm_hand_.body().getLinkTorque(i)) + p_WCom.cross(f_W);
    }
    return sum;
  }

  const double touch_ = experiment().ball.radius + experiment().hand.finger_radius;
  ArmHand arm_hand_{experiment().arm, experiment().hand, model::HandVector::Zero()};
  BallContacts contacts_{experiment().hand, experiment().ball};
  BallMotion ball_;
};

TEST_F(BallContact, AFingerPushesByItsDeformationAlongItsNormal) {
  for (const double y : {1e-9, 1e-4, 1e-3, 5e-3}) {
    for (int finger = 0; finger < model::kFingers; ++finger) {
      std::array<double, model::kFingers> distances;
      distances.fill(touch_ + 0.005);
      distances[finger] = touch_ - y;
      close(distances);
      const Wrench wrench = contacts_.step(arm_hand_, ball_, kStep);
      const double azimuth = experiment().hand.azimuth[finger];
      const Vector3d n_H(-std::cos(azimuth), -std::sin(azimuth), 0);
      const double force = model::elasticForce(experiment().ball, y);
      EXPECT_LT((inHand(wrench.force) - force * n_H).norm(), 1e-6 * force + 1e-12);
      EXPECT_NEAR(contacts_.forces()[finger].normal, force, 1e-6 * force + 1e-12);
      EXPECT_TRUE(contacts_.touching()[finger]);
    }
  }
}

TEST_F(BallContact, ForceAndReactionAreEqualAndOpposite) {
  close({touch_ - 1e-3, touch_ - 2e-3, touch_ - 1.5e-3});
  ball_.v_WBall = Vector3d(0.02, -0.03, 0.01);
  ball_.w_WBall = Vector3d(1, -2, 3);
  arm_hand_.body().clearForcesAndTorques();
  const Wrench wrench = contacts_.step(arm_hand_, ball_, kStep);
  const Wrench reaction = onLinks();
  EXPECT_GT(wrench.moment.norm(), 1e-4);
  EXPECT_LT((wrench.force + reaction.force).norm(), 1e-12);
  const Vector3d about_origin = wrench.moment + ball_.p_WBall.cross(wrench.force);
  EXPECT_LT((about_origin + reaction.moment).norm(), 1e-12);
}

TEST_F(BallContact, FrictionIsFeltInTheTangentialForce) {
  close({touch_ + 0.005, touch_ - 1e-3, touch_ + 0.005});
  // The ball slides distally along the thumb, which holds it back.
  ball_.v_WBall = arm_hand_.motion(kHandLink).X_WF.linear() * Vector3d(0, 0, 0.1);
  contacts_.step(arm_hand_, ball_, kStep);
  const FingerForce& thumb = contacts_.forces()[model::kThumb];
  EXPECT_LT(thumb.tangential[0], 0);
  EXPECT_NEAR(thumb.tangential[1], 0, 1e-12);
  EXPECT_LE(thumb.tangential.norm(), experiment().ball.friction * thumb.normal * (1 + 1e-12));
}

TEST_F(BallContact, ThePalmPushesDistally) {
  close({touch_ + 0.005, touch_ + 0.005, touch_ + 0.005});
  const double y = 2e-3;
  const double z = experiment().hand.palm_distance + experiment().ball.radius - y;
  ball_.p_WBall = arm_hand_.motion(kHandLink).X_WF * Vector3d(0, 0, z);
  const Wrench wrench = contacts_.step(arm_hand_, ball_, kStep);
  const double force = model::elasticForce(experiment().ball, y);
  EXPECT_LT((inHand(wrench.force) - Vector3d(0, 0, force)).norm(), 1e-9);
  EXPECT_TRUE(contacts_.touching()[BallContacts::kPalm]);
}

// A straight finger is one capsule: the sphere at its joint must not push twice.
TEST_F(BallContact, TheSphereAtTheJointPushesOnce) {
  arm_hand_.setState({experiment().q_rest, model::HandVector::Zero()}, {});
  arm_hand_.updateKinematics();
  const double y = 1e-3;
  const double force = model::elasticForce(experiment().ball, y);
  const model::HandParameters& hand = experiment().hand;
  const double joint = hand.base_distance + hand.proximal_length;
  for (const double z : {joint - 1e-3, joint - 1e-9, joint, joint + 1e-9, joint + 1e-3}) {
    // Beside the thumb, outside the hand: nothing else is near.
    ball_.p_WBall =
        arm_hand_.motion(kHandLink).X_WF * Vector3d(0, hand.base_radius + touch_ - y, z);
    contacts_.step(arm_hand_, ball_, kStep);
    EXPECT_NEAR(contacts_.forces()[model::kThumb].normal, force, 1e-9 * force) << "at z = " << z;
  }
}

TEST_F(BallContact, NothingTouchesABallThatIsAway) {
  close({touch_, touch_, touch_});
  for (const double away : {0.12, 0.5, 10.0}) {
    BallMotion ball = ball_;
    ball.p_WBall += away * arm_hand_.motion(kHandLink).X_WF.linear().col(2);
    const Wrench wrench = contacts_.step(arm_hand_, ball, kStep);
    EXPECT_EQ(wrench.force.norm(), 0);
    for (const bool touching : contacts_.touching())
      EXPECT_FALSE(touching);
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
