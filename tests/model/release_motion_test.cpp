// What the fingers are told while they let the ball go, in each mode.
#include "model/release_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/contact.h"
#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

constexpr FingerForces kTouch{1, 1, 1};
const std::array<Finger, kFingers> kEach{kFingerA, kThumb, kFingerB};

class Motion : public testing::Test {
 protected:
  ReleaseMotion motion(ReleaseMode mode) const { return {hand_, grasp_, settings_, mode}; }
  /// Told at t [s]; the fingers are where they were told to be.
  JointTargets at(ReleaseMotion& motion, double t, const FingerForces& force = kTouch) {
    motion.step(std::llround(1e6 * t), last_.q, last_.qd, force, last_);
    return last_;
  }
  double distance(Finger finger, const HandVector& q) const {
    return hand_.phalanges(finger, q)[1].p_end.head<2>().norm();
  }

  Hand hand_{exampleHand()};
  ReleaseSettings settings_ = exampleRelease();
  GraspGeometry grasp_ = grasp(exampleBall(), hand_, 6);
  JointTargets last_{grasp_.q};
};

TEST_F(Motion, ARetreatTakesAllFingersBackInProportionToHowDeepTheyPress) {
  ReleaseMotion motion = this->motion(ReleaseMode::kSyncRetreat);
  const double end = settings_.relax_time;
  for (double t = 0; t < end; t += 1e-3) {
    const JointTargets told = at(motion, t);
    const double share = settings_.retreat_ratio * smoothStep(t / end);
    for (const Finger finger : kEach) {
      const FingerGrasp& held = grasp_.fingers[finger];
      EXPECT_NEAR(distance(finger, told.q), held.distance + share * held.deformation, 1e-12);
      const int proximal = Hand::proximalJoint(finger);
      EXPECT_NEAR(told.q[proximal] + told.q[proximal + 1], 0, 1e-12) << "parallel";
      const double left = std::max(0.0, 1 - share);
      EXPECT_NEAR(told.tau[proximal], left * left * held.torque[1], 1e-12);
    }
  }
}

TEST_F(Motion, ASpeedIsThatOfTheAngle) {
  const double h = 1e-6;
  for (double t = 2e-3; t < settings_.relax_time; t += 3e-3) {
    ReleaseMotion before = motion(ReleaseMode::kSyncRetreat), after = before, now = before;
    const HandVector slope = (at(after, t + h).q - at(before, t - h).q) / (2 * h);
    EXPECT_LT((at(now, t).qd - slope).tail<8>().norm(), 1e-6 * (1 + slope.norm())) << t;
  }
}

// A ball of any stiffness is let go by all fingers at once, if it is pressed no deeper than they go.
TEST_F(Motion, ARetreatLeavesTheForcesInBalance) {
  BallParameters ball = exampleBall();
  for (const double modulus : {2e5, 5e5, 1e6}) {
    ball.youngs_modulus = modulus;
    const GraspGeometry held = grasp(ball, hand_, 6);
    ReleaseMotion motion = this->motion(ReleaseMode::kSyncRetreat);
    double most = 0;
    for (double t = 0; t < settings_.relax_time; t += 1e-3) {
      const JointTargets told = at(motion, t);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Finger finger : kEach) {
        const double gone = distance(finger, told.q) - grasp_.fingers[finger].distance;
        sum +=
            elasticForce(ball, held.fingers[finger].deformation - gone) * held.fingers[finger].n_H;
      }
      most = std::max(most, sum.norm());
    }
    EXPECT_LT(most, 0.15) << "N, of 6 N; E = " << modulus;
  }
}

TEST_F(Motion, AFadingThumbIsForceAlone) {
  ReleaseMotion motion = this->motion(ReleaseMode::kThumbFade);
  for (double t = 0; t < settings_.relax_time; t += 2e-3) {
    const JointTargets told = at(motion, t);
    const double left = 1 - smoothStep(t / settings_.relax_time);
    EXPECT_EQ(told.kp[kProximalThumb], 0);
    EXPECT_NEAR(told.tau[kProximalThumb], left * left * grasp_.fingers[kThumb].torque[1], 1e-12);
    EXPECT_EQ(told.q[kProximalA], grasp_.q[kProximalA]) << "the others hold";
    EXPECT_EQ(told.tau[kProximalA], grasp_.fingers[kFingerA].torque[1]);
  }
}

TEST_F(Motion, AnAbruptThumbIsPushedAtOnceAndTheOthersHold) {
  ReleaseMotion motion = this->motion(ReleaseMode::kAbrupt);
  const JointTargets told = at(motion, 0);
  EXPECT_EQ(told.tau[kProximalThumb], -exampleHand().finger_torque_max);
  EXPECT_EQ(told.kp[kProximalThumb], 0);
  EXPECT_EQ(told.q[kProximalB], grasp_.q[kProximalB]);
  EXPECT_FALSE(motion.opening());
}

TEST_F(Motion, AFingerThatFeelsTheBallNoMoreOpensTheThumb) {
  for (const Finger finger : kEach) {
    ReleaseMotion motion = this->motion(ReleaseMode::kSyncRetreat);
    EXPECT_GT(at(motion, 0.015).kp[kProximalThumb], 0);
    FingerForces force = kTouch;
    force[finger] = 0;
    EXPECT_EQ(at(motion, 0.016, force).tau[kProximalThumb], -exampleHand().finger_torque_max);
    EXPECT_EQ(at(motion, 0.017).kp[kProximalThumb], 0) << "it does not come back";
  }
}

TEST_F(Motion, InTheEndAllFingersAreClear) {
  for (const ReleaseMode mode :
       {ReleaseMode::kAbrupt, ReleaseMode::kThumbFade, ReleaseMode::kSyncRetreat}) {
    ReleaseMotion motion = this->motion(mode);
    JointTargets told;
    for (int k = 0; k < 300; ++k) {
      if (mode == ReleaseMode::kAbrupt && k == 10)
        motion.open(10'000);
      told = at(motion, 1e-3 * k);
      for (int j = kSpreadA; j < kHandJoints; ++j) {
        if (told.kp[j] == 0) {  // moved by its torque alone
          last_.qd[j] += 1e-3 * told.tau[j] / 7e-4;
          last_.q[j] += 1e-3 * last_.qd[j];
        }
      }
    }
    EXPECT_TRUE(motion.opening());
    EXPECT_NEAR(distance(kFingerA, told.q), settings_.open_distance, 1e-9);
    EXPECT_NEAR(distance(kFingerB, told.q), settings_.open_distance, 1e-9);
    EXPECT_NEAR(told.q[kProximalThumb], settings_.thumb.open_angle, 1e-9);
  }
}

TEST(ReleaseSettings, AWindowAsLongAsHalfTheRelaxationCounts) {
  const ReleaseSettings settings = exampleRelease();
  EXPECT_EQ(settings.modeFor(0.002), ReleaseMode::kAbrupt);
  EXPECT_EQ(settings.modeFor(0.02), ReleaseMode::kSyncRetreat);
  // S = 1 / 1.6 at 0.5675 of the time.
  EXPECT_NEAR(settings.delayOf(ReleaseMode::kSyncRetreat), 0.01986, 1e-5);
}

}  // namespace
}  // namespace fastball::model
