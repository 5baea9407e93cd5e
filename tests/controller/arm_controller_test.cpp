// The state machine in closed loop with the model of the arm.
#include "controller/arm_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/controller/closed_loop.h"

namespace fastball::controller {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int64_t kSceneUs = 10'000'000;
constexpr int64_t kStartUs = kSceneUs + 600'000;

/// A robot in lockstep with a controller.
class Throw : public testing::Test {
 protected:
  void arm() {
    ASSERT_TRUE(controller_.offerPlan(swingPlan()));
    ASSERT_TRUE(controller_.startThrow({1, 1, kStartUs}));
  }
  ArmSample sample() const { return {utime_, scene_, tick_, robot_.q, robot_.qd}; }
  /// One tick. Nothing is answered to a state that is too old.
  Answer tick() {
    const Answer answer = controller_.answer(sample()).value();
    robot_.tick(answer.tau);
    ++tick_;
    utime_ += 1000;
    return answer;
  }
  Answer run(int ticks) {
    Answer last;
    for (int i = 0; i < ticks; ++i)
      last = tick();
    return last;
  }

  ArmController controller_ = testController();
  SimulatedArm robot_{testArm(), kBack};
  int64_t scene_ = 1, tick_ = 0, utime_ = kSceneUs;
};

TEST_F(Throw, WithoutAPlanTheArmIsHeldWhereItIs) {
  const Answer answer = run(500);
  EXPECT_EQ(answer.phase, Phase::kIdle);
  EXPECT_EQ(answer.plan_id, 0);
  EXPECT_LT((robot_.q - kBack).norm(), 1e-6);
}

TEST_F(Throw, PhasesComeAtTheTimesOfThePlan) {
  arm();
  EXPECT_TRUE(controller_.armed());
  std::map<Phase, int> first_tick;
  for (int i = 0; i < 1800; ++i)
    first_tick.emplace(tick().phase, i);
  EXPECT_EQ(first_tick, (std::map<Phase, int>{{Phase::kIdle, 0},
                                              {Phase::kApproach, 600},
                                              {Phase::kReady, 650},
                                              {Phase::kSwing, 700},
                                              {Phase::kFollowThrough, 1500},
                                              {Phase::kHold, 1600}}));
  EXPECT_LT((robot_.q - kFront).norm(), 1e-4);
  EXPECT_LT(controller_.status().q_error_max.maxCoeff(), 1e-3);
  EXPECT_EQ(controller_.status().saturations, 0);
  EXPECT_EQ(controller_.notice(), "");
}

TEST_F(Throw, TheSameStateAgainGetsTheSameAnswerAndChangesNothing) {
  arm();
  run(1000);
  const Answer first = controller_.answer(sample()).value();
  for (int i = 0; i < 3; ++i) {
    const Answer again = controller_.answer(sample()).value();
    EXPECT_EQ(again.tau, first.tau);
    EXPECT_EQ(again.phase, first.phase);
  }
  // A twin that hears nothing twice ends at the same place, bit for bit.
  run(700);
  ArmController twin = testController();
  SimulatedArm robot{testArm(), kBack};
  twin.offerPlan(swingPlan());
  twin.startThrow({1, 1, kStartUs});
  for (int i = 0; i < 1700; ++i)
    robot.tick(twin.answer({kSceneUs + 1000 * i, 1, i, robot.q, robot.qd})->tau);
  EXPECT_EQ(robot.q, robot_.q);
}

TEST_F(Throw, RepeatedPlanAndOrderChangeNothing) {
  arm();
  run(1000);
  EXPECT_TRUE(controller_.offerPlan(swingPlan()));
  EXPECT_TRUE(controller_.startThrow({1, 1, kStartUs}));
  EXPECT_EQ(tick().phase, Phase::kSwing);
  EXPECT_FALSE(controller_.planned());
}

TEST_F(Throw, AnOldStateGetsNoAnswer) {
  run(10);
  const ArmSample old = sample();
  run(10);
  EXPECT_FALSE(controller_.answer(old));
  EXPECT_EQ(controller_.status().stale_states, 1);
}

TEST_F(Throw, TheLastStatesOfAnOlderSceneDoNotDisturbTheNextThrow) {
  run(50);
  const ArmSample old = sample();
  ASSERT_TRUE(controller_.offerPlan(swingPlan(2)));
  ASSERT_TRUE(controller_.startThrow({2, 2, kStartUs + kSceneUs}));
  EXPECT_EQ(tick().plan_id, 0);
  EXPECT_TRUE(controller_.armed());
  scene_ = 2;
  tick_ = 0;
  utime_ = 2 * kSceneUs;
  EXPECT_EQ(tick().plan_id, 2);
  EXPECT_FALSE(controller_.answer(old));
  EXPECT_EQ(run(650).phase, Phase::kReady);
}

TEST_F(Throw, ASmallDistanceFromThePlanIsMadeUpBeforeItStarts) {
  robot_.q[0] += 0.015;
  arm();
  const double first_torque = tick().tau[0];
  EXPECT_NEAR(first_torque, testArm().gravityTorque(robot_.q)[0], 1) << "no jerk";
  run(599);
  EXPECT_LT((robot_.q - kBack).norm(), 1e-4);
}

TEST_F(Throw, APlanThatStartsElsewhereIsRefusedAtTheFirstStateOfItsScene) {
  robot_.q[2] += 0.1;
  arm();
  EXPECT_EQ(run(2000).phase, Phase::kIdle);
  EXPECT_TRUE(controller_.refused());
  EXPECT_THAT(controller_.notice(), AllOf(HasSubstr("joint 3 starts at"), HasSubstr("0.02 rad")));
}

TEST_F(Throw, AnOrderForAnotherPlanOrForThePastIsRefused) {
  EXPECT_FALSE(controller_.startThrow({1, 1, kStartUs}));
  EXPECT_THAT(controller_.notice(), HasSubstr("no plan is held"));
  controller_.offerPlan(swingPlan());
  EXPECT_FALSE(controller_.startThrow({3, 1, kStartUs}));
  EXPECT_THAT(controller_.notice(), HasSubstr("the plan held is 1"));
  run(100);
  EXPECT_FALSE(controller_.startThrow({1, 1, kSceneUs + 50'000}));
  EXPECT_THAT(controller_.notice(), HasSubstr("scene 1 is at"));
}

// A robot that has no scenes but goes on and on is given its orders while it holds.
TEST_F(Throw, APlanCanBeOrderedWithinTheScene) {
  run(100);
  ASSERT_TRUE(controller_.offerPlan(swingPlan()));
  ASSERT_TRUE(controller_.startThrow({1, 1, kStartUs}));
  EXPECT_EQ(run(700).phase, Phase::kSwing);
}

TEST_F(Throw, EstopInMidSwingBrakesInsideTheLimitsAndHolds) {
  arm();
  run(1100);
  ASSERT_GT(testArm().speedRatio(robot_.qd), 0.7);
  const Eigen::Vector4d q_stop = robot_.q;
  controller_.stop("ESTOP: somebody came near");
  int ticks = 0;
  for (; robot_.qd.norm() > 0.01 && ticks < 1000; ++ticks)
    EXPECT_EQ(tick().phase, Phase::kBrake);
  EXPECT_LT(ticks, 200);
  EXPECT_EQ(controller_.status().saturations, 0);
  const Eigen::Vector4d q_rest = robot_.q;
  EXPECT_EQ(run(1000).phase, Phase::kBrake);
  EXPECT_LT((robot_.q - q_rest).norm(), 1e-3);
  EXPECT_EQ(controller_.notice(), "ESTOP: somebody came near");
  RecordProperty("way_mrad", static_cast<int>((q_rest - q_stop).cwiseAbs().maxCoeff() * 1000));
}

TEST_F(Throw, AfterAnEstopANewPlanAndANewSceneAreNeeded) {
  arm();
  run(1000);
  controller_.stop("ESTOP: test");
  run(500);
  EXPECT_FALSE(controller_.offerPlan(swingPlan())) << "the interrupted one";
  EXPECT_THAT(controller_.notice(), HasSubstr("interrupted"));
  robot_.q = kBack;
  EXPECT_TRUE(controller_.offerPlan(swingPlan(2)));
  EXPECT_FALSE(controller_.startThrow({2, 1, utime_ + 500'000})) << "the same scene";
  EXPECT_TRUE(controller_.startThrow({2, 2, 2 * kSceneUs + 600'000}));
  robot_ = {testArm(), kBack};
  scene_ = 2;
  tick_ = 0;
  utime_ = 2 * kSceneUs;
  EXPECT_EQ(run(800).phase, Phase::kSwing);
}

TEST_F(Throw, AGapInTheStatesBrakes) {
  arm();
  run(1000);
  utime_ += 30'000;
  tick_ += 30;
  EXPECT_EQ(tick().phase, Phase::kBrake);
  EXPECT_THAT(controller_.notice(),
              AllOf(HasSubstr("no state"), HasSubstr("31 ms"), HasSubstr("20 ms")));
}

/// Heard again after a gap in which it has come to rest by itself, elsewhere than the controller would have brought it.
TEST_F(Throw, AnArmThatBrakedByItselfMeanwhileIsNotPulledElsewhere) {
  arm();
  run(1100);
  controller_.stop("ESTOP: test");
  run(5);
  ASSERT_GT(robot_.qd.norm(), 0.5);
  robot_.q += 0.01 * robot_.qd;
  robot_.qd.setZero();
  const Eigen::Vector4d q_rest = robot_.q;
  utime_ += 500'000;
  tick_ += 500;
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(tick().phase, Phase::kBrake);
    EXPECT_LT(robot_.qd.norm(), 0.05);
  }
  EXPECT_LT((robot_.q - q_rest).norm(), 1e-3);
  EXPECT_EQ(controller_.notice(), "ESTOP: test");
}

/// All its states are heard, but it does not hear the commands.
TEST_F(Throw, ABrakedArmThatIsFarFromWhereItShouldBeIsNotPulledThere) {
  arm();
  run(1100);
  controller_.stop("ESTOP: test");
  run(500);
  const Eigen::Vector4d q_rest = robot_.q += Eigen::Vector4d(0.15, 0, 0, -0.15);
  run(500);
  EXPECT_LT((robot_.q - q_rest).norm(), 1e-3);
}

TEST_F(Throw, AJointBeyondItsStopBrakes) {
  run(10);
  robot_.q[3] = 3.2;
  EXPECT_EQ(tick().phase, Phase::kBrake);
  EXPECT_THAT(controller_.notice(),
              AllOf(HasSubstr("joint 4"), HasSubstr("3.2 rad"), HasSubstr("3.1 rad")));
}

TEST_F(Throw, TooMuchSpeedBrakes) {
  run(10);
  robot_.qd[0] = 3;
  EXPECT_EQ(tick().phase, Phase::kBrake);
  EXPECT_THAT(controller_.notice(), HasSubstr("times its speed limit"));
}

TEST_F(Throw, AnArmThatIsPushedAwayBrakes) {
  arm();
  run(1000);
  robot_.q[1] += 0.15;
  EXPECT_EQ(tick().phase, Phase::kBrake);
  EXPECT_THAT(controller_.notice(), AllOf(HasSubstr("joint 2"), HasSubstr("0.1 rad is allowed")));
}

TEST_F(Throw, ABadPlanTakesThePlaceOfAGoodOneThatWasHeld) {
  controller_.offerPlan(swingPlan());
  Plan bad = swingPlan(2);
  bad.t_swing = -1;
  EXPECT_FALSE(controller_.offerPlan(bad));
  EXPECT_TRUE(controller_.refused());
  EXPECT_EQ(controller_.planId(), 2);
  EXPECT_FALSE(controller_.startThrow({1, 1, kStartUs}));
}

}  // namespace
}  // namespace fastball::controller
