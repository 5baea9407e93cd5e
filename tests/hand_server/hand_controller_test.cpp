// The hand through a throw: phases, forces, release, and what it does when something is wrong.
#include "hand_server/hand_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/hand_server/hand_throw.h"

namespace fastball::hand_server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST_F(HandThrow, WithoutAThrowTheFingersAreApart) {
  const HandAnswer answer = run(500);
  EXPECT_EQ(answer.phase, Phase::kOpen);
  const double d = config_.release.open_distance;
  EXPECT_LT((answer.q - testHand().posture(0, 0, {d, d, d})).norm(), 1e-12);
  EXPECT_TRUE(answer.tau.isZero(0));
}

TEST_F(HandThrow, PhasesComeAtTheirTimes) {
  arm();
  std::map<Phase, int> first_tick;
  for (int i = 0; i < 1300; ++i) {
    if (i > 1108)  // 8 ms after the command
      force_ = {0, 0, 0};
    first_tick.emplace(tick().phase, i);
  }
  EXPECT_EQ(first_tick, (std::map<Phase, int>{{Phase::kGrasp, 0},
                                              {Phase::kHold, 250},
                                              {Phase::kRelease, 1100},
                                              {Phase::kClear, 1111}}));
}

TEST_F(HandThrow, TheGraspClosesSmoothlyAndPressesAsTheBallIsDeformed) {
  arm();
  HandAnswer before = tick();
  double largest_step = 0, thumb_torque = 0;
  for (int i = 1; i < 300; ++i) {
    const HandAnswer answer = tick();
    largest_step = std::max(largest_step, (answer.q - before.q).cwiseAbs().maxCoeff());
    EXPECT_GE(answer.tau[model::kProximalThumb], thumb_torque);
    thumb_torque = answer.tau[model::kProximalThumb];
    before = answer;
  }
  EXPECT_LT(largest_step, 1e-3 * experiment().hand.joint_speed_max);
  const model::GraspGeometry grasp = model::grasp(experiment().ball, testHand(), 4.0);
  EXPECT_LT((before.q.tail<8>() - grasp.q.tail<8>()).norm(), 1e-12);
  EXPECT_NEAR(thumb_torque, grasp.fingers[model::kThumb].torque[1], 1e-12);
  EXPECT_NEAR(before.q[model::kWristRoll], 0.1, 1e-12);
  EXPECT_NEAR(before.q[model::kWristFlexion], -0.05, 1e-12);
}

// Section 3.1, i-iii.
TEST_F(HandThrow, InTheReleaseTheThumbOpensAndTheOtherFingersStay) {
  arm();
  const HandAnswer held = run(1100);
  const HandAnswer first = tick();
  EXPECT_EQ(first.phase, Phase::kRelease);
  EXPECT_EQ(first.kp[model::kProximalThumb], 0);
  EXPECT_EQ(first.tau[model::kProximalThumb], -experiment().hand.finger_torque_max);
  for (int i = 0; i < 50; ++i) {
    const HandAnswer answer = tick();
    for (const int j : {model::kSpreadA, model::kProximalA, model::kDistalA, model::kSpreadB,
                        model::kProximalB, model::kDistalB}) {
      EXPECT_EQ(answer.q[j], held.q[j]);
      EXPECT_EQ(answer.tau[j], held.tau[j]);
      EXPECT_EQ(answer.kp[j], held.kp[j]);
    }
  }
  run(200);
  EXPECT_NEAR(hand_.q[model::kProximalThumb], config_.release.thumb.open_angle, 1e-3);
  EXPECT_EQ(hand_.qd[model::kProximalThumb], 0);
}

TEST_F(HandThrow, HowTheBallLiesIsSaidAlikeInTheLastTicksBeforeAPlanThatAdaptsStarts) {
  HandPlan plan = throwPlan();
  plan.adapts = true;
  ASSERT_TRUE(controller_.offerPlan(plan));
  ASSERT_TRUE(controller_.startThrow({1, 1, kStartUs}));
  std::vector<int64_t> ticks;
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 800; ++i) {
    tick();
    if (const auto grip = controller_.gripBeforeStart()) {
      ticks.push_back(tick_ - 1);
      places.push_back(grip->p_HBall);
    }
  }
  ASSERT_EQ(ticks.size(), 20U);
  EXPECT_EQ(ticks.front(), 580);
  EXPECT_EQ(ticks.back(), 599);
  for (const Eigen::Vector3d& p_HBall : places)
    EXPECT_EQ(p_HBall, places.front());
  EXPECT_EQ(places.front().z(), experiment().hand.p_HBall.z()) << "this hand measures no torques";
}

TEST_F(HandThrow, HowTheBallLiesIsNotSaidOfOtherPlans) {
  arm();
  for (int i = 0; i < 800; ++i) {
    tick();
    EXPECT_FALSE(controller_.gripBeforeStart());
  }
}

TEST_F(HandThrow, ReleaseAndDepartureAreSaidOnceEach) {
  arm();
  run(1106);
  force_ = {0.02, 0, 0.3};
  run(2);
  force_ = {0.02, 0, 0.02};
  run(200);
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[0].kind, ReleaseEvent::Kind::kCommanded);
  EXPECT_EQ(events_[0].reason, ReleaseBy::kPlanTime);
  EXPECT_EQ(events_[0].utime, kStartUs + 500'000);
  EXPECT_EQ(events_[0].planned_utime, kStartUs + 500'000);
  EXPECT_EQ(events_[0].force[1], 4.0);
  EXPECT_EQ(events_[1].kind, ReleaseEvent::Kind::kDeparted);
  const int64_t delay = std::llround(1e6 * config_.force_delay);
  EXPECT_GT(events_[1].utime, kStartUs + 506'000 - delay) << "in the tick of the last touch";
  EXPECT_LE(events_[1].utime, kStartUs + 508'000 - delay) << "or in the one after it";
  EXPECT_EQ(events_[1].planned_utime, kStartUs + 510'000);
  EXPECT_EQ(events_[1].force[2], 0.3);
}

TEST_F(HandThrow, InAReleaseWindowAllFingersRetreatAndOpen) {
  arm(0.04);
  const HandAnswer held = run(1100);
  HandAnswer answer = run(20);
  EXPECT_EQ(answer.phase, Phase::kRelease);
  for (const int joint : {model::kProximalA, model::kProximalThumb, model::kProximalB}) {
    EXPECT_LT(answer.q[joint], held.q[joint]);
    EXPECT_LT(answer.tau[joint], 0.1 * held.tau[joint]);
    EXPECT_GT(answer.kp[joint], 0);
  }
  answer = run(18);
  EXPECT_EQ(answer.phase, Phase::kClear)
      << "2 ms after the retreat, whether the ball has left or not";
  EXPECT_EQ(answer.tau[model::kProximalThumb], -experiment().hand.finger_torque_max);
  answer = run(150);
  EXPECT_NEAR(answer.q[model::kProximalThumb], config_.release.thumb.open_angle, 1e-9);
}

TEST_F(HandThrow, ABallThatIsTouchedAgainIsSaid) {
  arm();
  run(1105);
  force_ = {0, 0, 0};
  run(20);
  force_ = {0, 0, 0.4};
  run(1);
  EXPECT_THAT(controller_.notice(),
              MatchesRegex("finger B touched the ball again 2[01].*ms after it had left"));
}

TEST_F(HandThrow, ABallThatTheFingersDoNotCarryIsSaidBeforeTheRelease) {
  arm();
  carried_ = -1;
  run(1090);
  EXPECT_THAT(controller_.notice(), AllOf(HasSubstr("the ball slips"), HasSubstr("N of the")));
  EXPECT_EQ(controller_.phase(), Phase::kHold);
}

TEST_F(HandThrow, ABounceShorterThanTheQuietTimeIsNoDeparture) {
  arm();
  run(1105);
  force_ = {0, 0, 0};
  run(2);
  force_ = {1, 0, 1};
  run(1);
  force_ = {0, 0, 0};
  run(10);
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[1].utime, kStartUs + 507'000);
}

TEST_F(HandThrow, ABallThatStaysIsLeftAfterAWhile) {
  arm();
  run(1160);
  EXPECT_EQ(tick().phase, Phase::kClear);
  EXPECT_EQ(events_.size(), 1u) << "it has not departed";
}

TEST_F(HandThrow, ABallThatWasNeverGrippedIsSaid) {
  arm();
  force_ = {0, 0.3, 0};
  run(790);
  EXPECT_EQ(controller_.notice(), "");
  run(20);
  EXPECT_EQ(controller_.notice(), "the ball is not gripped: the thumb presses with 0.3 N of 4 N");
}

TEST_F(HandThrow, TheSameStateAgainGetsTheSameAnswerAndNoSecondEvent) {
  arm();
  run(1100);
  const HandAnswer first = controller_.answer(sample()).value();
  EXPECT_TRUE(controller_.takeEvent());
  for (int i = 0; i < 3; ++i) {
    const HandAnswer again = controller_.answer(sample()).value();
    EXPECT_EQ(again.tau, first.tau);
    EXPECT_EQ(again.q, first.q);
    EXPECT_FALSE(controller_.takeEvent());
  }
}

TEST_F(HandThrow, AfterAnEstopTheGripIsKept) {
  arm();
  run(900);
  controller_.keep("ESTOP: test");
  EXPECT_EQ(run(500).phase, Phase::kHold);
  EXPECT_TRUE(events_.empty());
  EXPECT_TRUE(controller_.kept());
  EXPECT_FALSE(controller_.offerPlan(throwPlan())) << "the interrupted one";
  EXPECT_TRUE(controller_.offerPlan(throwPlan(2)));
  EXPECT_TRUE(controller_.startThrow({2, 2, 2 * kSceneUs + 600'000}));
  scene_ = 2;
  tick_ = 0;
  utime_ = 2 * kSceneUs;
  EXPECT_EQ(tick().phase, Phase::kGrasp);
  EXPECT_FALSE(controller_.kept());
}

TEST_F(HandThrow, TheBallIsKeptWhenTheArmDoesNotFollowThePlan) {
  arm();
  run(900);
  const Eigen::Vector4d q = throwPlan().arm.at(0.3).q;
  controller_.watchArm(1, kStartUs + 300'000, q);
  EXPECT_FALSE(controller_.kept());
  controller_.watchArm(1, kStartUs + 300'000, q + 0.2 * Eigen::Vector4d::Unit(3));
  EXPECT_EQ(run(500).phase, Phase::kHold);
  EXPECT_THAT(controller_.notice(),
              AllOf(HasSubstr("joint 4"), HasSubstr("0.2 rad"), HasSubstr("plan 1")));
}

TEST_F(HandThrow, StatesOfAnOlderSceneAreNotAnswered) {
  run(50);
  const HandSample old = sample();
  scene_ = 2;
  tick_ = 0;
  utime_ = 2 * kSceneUs;
  tick();
  EXPECT_FALSE(controller_.answer(old));
}

TEST_F(HandThrow, PlansThatTheHandCannotDoAreRefusedWithASentence) {
  const auto refusal = [this](const std::function<void(HandPlan&)>& change) {
    HandPlan plan = throwPlan(3);
    change(plan);
    EXPECT_FALSE(controller_.offerPlan(plan));
    EXPECT_TRUE(controller_.refused());
    return controller_.notice();
  };
  EXPECT_EQ(refusal([](HandPlan& p) { p.grip_force = 0; }),
            "plan 3: a grip of 0 N does not hold the ball, it must be positive");
  EXPECT_THAT(refusal([](HandPlan& p) { p.grip_force = 1e4; }), HasSubstr("plan 3: "));
  EXPECT_THAT(refusal([](HandPlan& p) { p.grip_force = 60; }),
              AllOf(HasSubstr("a grip of 60 N needs"), HasSubstr("limit is 1.2 N m")));
  EXPECT_THAT(refusal([](HandPlan& p) { p.q_wrist[1] = 4; }),
              AllOf(HasSubstr("wrist flexion of 4 rad"), HasSubstr("3.2 rad")));
  EXPECT_THAT(refusal([](HandPlan& p) { p.t_release_command = 3; }),
              HasSubstr("release is commanded at 3 s"));
}

}  // namespace
}  // namespace fastball::hand_server
