// Eq. (24) against motions made by hand.
#include "hand_server/release_condition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

const Eigen::Vector3d kBall{0, 0, 0.15};

double pushing(const model::ArmMotion& motion) {
  return pushingAcceleration(testArm(), motion, testHand().X_TH(0, 0), kBall);
}

// Joint 1 turns the level, stretched arm: the ball's acceleration along y of the hand is radius times ddq1.
TEST(PushingAcceleration, OfALevelArmThatTurnsAboutTheVertical) {
  model::ArmMotion motion;
  motion.q = {0.3, M_PI / 2, 0, 0};
  const double radius = 0.55 + 0.35 + 0.15;
  for (const double qdd : {-20.0, 0.0, 1e-3, 20.0}) {
    for (const double qd : {0.0, 2.0}) {
      motion.qd[0] = qd;
      motion.qdd[0] = qdd;
      EXPECT_NEAR(pushing(motion), radius * qdd, 1e-9);
    }
  }
}

// With the hand turned over by a quarter, y points down: an arm that falls freely does not push.
TEST(PushingAcceleration, WeightCounts) {
  model::ArmMotion motion;
  motion.q = {0.3, M_PI / 2, -M_PI / 2, 0};
  const double down = testArm().X_WT(motion.q).linear().col(1).z();
  ASSERT_NEAR(std::abs(down), 1, 1e-9);
  EXPECT_NEAR(pushing(motion), 9.81 * down, 1e-9);
}

TEST(PushEnd, IsWhereThePushEndsNotWhereItHasNotBegun) {
  PushEnd end;
  for (const double value : {-1.0, -0.1, 0.0, 3.0, 0.5})
    EXPECT_FALSE(end.reached(value)) << value;
  EXPECT_TRUE(end.reached(-0.1));
}

/// When the hand lets go of the ball in a level turn of joint 1 from 0.2 to 0.8 s, if the plan says `t_release_command` [s].
std::optional<ReleaseEvent> releaseByNormalForce(double t_release_command, std::string* notice) {
  HandServerConfig config = loadConfig(kExperimentPath);
  config.release_by = ReleaseBy::kNormalForce;
  HandController controller(testArm(), testHand(), experiment().ball, config);
  HandPlan plan = throwPlan();
  plan.t_release_command = t_release_command;
  plan.q_wrist.setZero();
  std::vector<model::ArmMotion> samples = plan.arm.samples();
  for (model::ArmMotion& sample : samples)
    sample.q.tail<3>() = Eigen::Vector3d(M_PI / 2, 0, 0);  // gravity has no part in it
  plan.arm = model::SampledTrajectory(0.01, samples);
  controller.offerPlan(plan);
  controller.startThrow({1, 1, 300'000});
  std::optional<ReleaseEvent> event;
  ScriptedHand hand;
  for (int i = 0; i < 1500 && !event; ++i) {
    hand.tick(*controller.answer({1000 * i, 1, i, hand.q, hand.qd, {1, 1, 1}}));
    event = controller.takeEvent();
  }
  *notice = controller.notice();
  return event;
}

// The quintic stops accelerating in its middle, at 0.5 s; the tick after is the first at which the hand falls behind.
TEST(NormalForce, ReleasesWhenThePushEnds) {
  for (const double planned : {0.46, 0.5, 0.54}) {
    std::string notice;
    const auto event = releaseByNormalForce(planned, &notice);
    ASSERT_TRUE(event) << notice;
    EXPECT_EQ(event->reason, ReleaseBy::kNormalForce);
    EXPECT_EQ(event->utime, 300'000 + 501'000);
  }
}

TEST(NormalForce, KeepsTheBallIfThePushEndsFarFromThePlannedRelease) {
  for (const double planned : {0.4, 0.7}) {
    std::string notice;
    EXPECT_FALSE(releaseByNormalForce(planned, &notice));
    EXPECT_THAT(notice, testing::HasSubstr("Eq. 24"));
  }
}

}  // namespace
}  // namespace fastball::hand_server
