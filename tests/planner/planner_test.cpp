// Whole plans: inside the limits, on the target, the same every time, or refused for a reason.

#include "planner/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/ball_flight.h"
#include "tests/planner/default_throw.h"
#include "tests/planner/plan_checks.h"

namespace fastball::planner {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The plan, or a failed test with the reason.
Plan expectPlan(const PlanResult& result) {
  if (const Refusal* refusal = std::get_if<Refusal>(&result)) {
    ADD_FAILURE() << refusal->sentence;
    return {};
  }
  return std::get<Plan>(result);
}

/// The refusal's sentence, empty if there is a plan.
std::string refusalOf(const PlanResult& result) {
  const Refusal* refusal = std::get_if<Refusal>(&result);
  return refusal == nullptr ? "" : refusal->sentence;
}

class PlannedThrow : public testing::Test {
 protected:
  DefaultThrow example_;
  Planner planner_{example_.config};
};

TEST_F(PlannedThrow, IsFastAndLandsInTheNet) {
  const ThrowRequest request = example_.request();
  const Plan plan = expectPlan(planner_.plan(request));
  EXPECT_GE(plan.release.v_WBall.norm(), 5.0);
  EXPECT_LE(plan.landing.norm(), 1e-3);
  const Eigen::Vector2d landing =
      landingOf(plan.release, request.target, example_.config.ball.dragPerMetre());
  EXPECT_LE(landing.norm(), 1e-3);
  EXPECT_EQ(limitFault(example_.config, plan), "");
}

TEST_F(PlannedThrow, GoesFromRestToRest) {
  const ThrowRequest request = example_.request();
  const Plan plan = expectPlan(planner_.plan(request));
  const auto& samples = plan.trajectory.samples();
  EXPECT_EQ(samples.front().q, request.q_arm);
  EXPECT_EQ(samples.front().qd.norm(), 0);
  EXPECT_EQ(samples.back().qd.norm(), 0);
  EXPECT_GE(plan.t_swing - plan.t_ready, 0.2 - 1e-9);
  for (double t = plan.t_ready; t <= plan.t_swing; t += 1e-3) {
    EXPECT_LE(plan.trajectory.at(t).qd.norm(), 1e-4) << "t = " << t;
  }
  EXPECT_LT(plan.trajectory.duration(), 2.4);
}

TEST_F(PlannedThrow, ApproachesGently) {
  const Plan plan = expectPlan(planner_.plan(example_.request()));
  for (double t = 0; t < plan.t_ready; t += 1e-3) {
    EXPECT_LE(planner_.arm().speedRatio(plan.trajectory.at(t).qd), 0.6 + 1e-3);
  }
}

TEST_F(PlannedThrow, HoldsTheShoulderPitchThroughTheSwing) {
  const Plan plan = expectPlan(planner_.plan(example_.request()));
  const double gamma = plan.trajectory.at(plan.t_swing).q[1];
  for (double t = plan.t_swing; t <= plan.trajectory.duration(); t += 1e-3) {
    EXPECT_NEAR(plan.trajectory.at(t).q[1], gamma, 1e-9);
  }
}

TEST_F(PlannedThrow, LetsGoOnAWholeMillisecondWithTheHandFallingBehind) {
  const Plan plan = expectPlan(planner_.plan(example_.request()));
  const double ms = 1e3 * plan.t_release_command;
  EXPECT_NEAR(ms, std::round(ms), 1e-9);
  EXPECT_LT(plan.t_release_command, plan.t_release);
  EXPECT_LT(plan.t_release, plan.t_swing_end);
  EXPECT_LT(plan.release_window[0], plan.t_release);
  EXPECT_GT(plan.release_window[1], plan.t_release);
  // Eq. (24) along the ball's path at the predicted release.
  const model::ArmMotion at = plan.trajectory.at(plan.t_release);
  const Eigen::Vector3d p_TBall =
      model::Hand(example_.config.hand).X_TH(plan.wrist_roll, plan.wrist_flexion) *
      example_.config.hand.p_HBall;
  const Eigen::Vector3d a_W = planner_.arm().pointAcceleration(at.q, at.qd, at.qdd, p_TBall);
  const Eigen::Vector3d forward = plan.release.v_WBall.normalized();
  EXPECT_LT((a_W + 9.81 * Eigen::Vector3d::UnitZ()).dot(forward), 0);
}

TEST_F(PlannedThrow, IsMadeByTheParametersThatItNames) {
  const Plan plan = expectPlan(planner_.plan(example_.request()));
  SwingVector x;
  for (int i = 0; i < kSwingVariables; ++i) {
    ASSERT_EQ(plan.parameters[i].first, swingVariableNames()[i]);
    x[i] = plan.parameters[i].second;
  }
  // The phases are given modulo 2 pi: the half wave in which the swing lies is the one about the release.
  for (const auto& [phi, omega] : {std::pair{kPhi1, kOmega1}, std::pair{kPhi3, kOmega3}}) {
    x[phi] =
        std::remainder(x[phi] + x[omega] * plan.t_release, 2 * M_PI) - x[omega] * plan.t_release;
  }
  const SwingCurve curve(x, 1);
  EXPECT_NEAR(curve.begin(), plan.t_swing, 1e-9);
  for (double t = plan.t_swing; t < plan.t_swing_end; t += 1e-3) {
    EXPECT_LT((curve.at(t).q - plan.trajectory.at(t).q).norm(), 1e-5) << "t = " << t;
  }
}

TEST_F(PlannedThrow, ExistsForNetsElsewhereAndOtherSeeds) {
  const std::vector<ThrowRequest> requests{
      example_.requestTo(3.0, 0.3, -0.3, 2), example_.requestTo(2.5, -0.4, -0.5, 3),
      example_.requestTo(3.3, 0.0, -0.6, 4), example_.requestTo(2.0, 1.8, 0.0, 5)};
  for (const ThrowRequest& request : requests) {
    SCOPED_TRACE(testing::PrintToString(request.target.p_WTarget.transpose()));
    const Plan plan = expectPlan(planner_.plan(request));
    ASSERT_GE(plan.trajectory.samples().size(), 2U);
    EXPECT_EQ(limitFault(example_.config, plan), "");
    EXPECT_LE(landingOf(plan.release, request.target, example_.config.ball.dragPerMetre()).norm(),
              1e-3);
  }
}

TEST_F(PlannedThrow, IsTheSameEveryTime) {
  const Plan first = expectPlan(planner_.plan(example_.request()));
  const Plan second = expectPlan(Planner(example_.config).plan(example_.request()));
  EXPECT_EQ(first.parameters, second.parameters);
  EXPECT_EQ(first.t_release, second.t_release);
  ASSERT_EQ(first.trajectory.samples().size(), second.trajectory.samples().size());
  for (std::size_t k = 0; k < first.trajectory.samples().size(); ++k) {
    EXPECT_EQ(first.trajectory.samples()[k].q, second.trajectory.samples()[k].q);
    EXPECT_EQ(first.trajectory.samples()[k].qdd, second.trajectory.samples()[k].qdd);
  }
}

TEST(PlannedInstantRelease, LeavesWithTheHand) {
  const DefaultThrow example;
  const Planner planner(example.config, instantDeparture(example.config));
  const Plan plan = expectPlan(planner.plan(example.request()));
  EXPECT_EQ(plan.t_release, plan.t_release_command);
  const model::ArmMotion at = plan.trajectory.at(plan.t_release);
  const Eigen::Isometry3d X_TH =
      model::Hand(example.config.hand).X_TH(plan.wrist_roll, plan.wrist_flexion);
  const Eigen::Vector3d p_TBall = X_TH * example.config.hand.p_HBall;
  EXPECT_LT((planner.arm().p_WPoint(at.q, p_TBall) - plan.release.p_WBall).norm(), 1e-9);
  const Eigen::Vector3d v_W = planner.arm().pointJacobian(at.q, p_TBall) * at.qd;
  EXPECT_LT((v_W - plan.release.v_WBall).norm(), 1e-9);
  EXPECT_GE(v_W.norm(), 5.0);
  // Eq. (25): across the fingers, but for what turns in the few milliseconds about its time.
  const Eigen::Matrix3d R_WH = planner.arm().X_WT(at.q).linear() * X_TH.linear();
  EXPECT_LT(std::abs(v_W.dot(R_WH.col(0))), 0.15);
  EXPECT_LT(std::abs(v_W.dot(R_WH.col(2))), 0.15);
  EXPECT_LE(std::abs(plan.wrist_flexion), example.config.swing.flexion_limit);
}

using RefusedThrow = PlannedThrow;

TEST_F(RefusedThrow, OutOfReachNamesTheSpeedsAndTheJoint) {
  EXPECT_THAT(refusalOf(planner_.plan(example_.requestTo(10, 0, -0.5))),
              AllOf(HasSubstr("out of reach"), HasSubstr("m/s or more would be needed"),
                    HasSubstr("the fastest throw found leaves at 7."), HasSubstr("rad/s")));
}

TEST_F(RefusedThrow, InsideTheReachOfTheArm) {
  EXPECT_THAT(refusalOf(planner_.plan(example_.requestTo(0.8, 0, -0.3))),
              AllOf(HasSubstr("0.854 m from the shoulder"), HasSubstr("1.15 m")));
}

TEST_F(RefusedThrow, UnknownStrategyListsTheKnownOnes) {
  ThrowRequest request = example_.request();
  request.strategy = "underarm";
  EXPECT_THAT(refusalOf(planner_.plan(request)),
              AllOf(HasSubstr("'underarm'"), HasSubstr("known strategies: paper")));
}

TEST_F(RefusedThrow, NotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ThrowRequest request = example_.request();
  request.target.p_WTarget.y() = nan;
  EXPECT_THAT(refusalOf(planner_.plan(request)), HasSubstr("not finite"));
  request = example_.request();
  request.q_arm[2] = nan;
  EXPECT_THAT(refusalOf(planner_.plan(request)), HasSubstr("not finite"));
}

TEST_F(RefusedThrow, FromAPoseAtAStop) {
  ThrowRequest request = example_.request();
  request.q_arm[3] = 3.1;
  EXPECT_THAT(refusalOf(planner_.plan(request)), AllOf(HasSubstr("joint 4"), HasSubstr("3.1 rad")));
}

TEST_F(RefusedThrow, NotIntoANetThatLiesFlatFacingUp) {
  ThrowRequest request = example_.request();
  request.target.n_WTarget = {0, 0, 1};
  const PlanResult result = planner_.plan(request);
  ASSERT_TRUE(std::holds_alternative<Plan>(result));
  const Plan& plan = std::get<Plan>(result);
  const auto landing =
      model::land(plan.release, request.target, example_.config.ball.dragPerMetre(),
                  example_.config.arm.gravity);
  ASSERT_TRUE(landing);
  EXPECT_LT(landing->landing.norm(), 1e-3);
  EXPECT_LT(landing->state.v_WBall.z(), 0);
}

}  // namespace
}  // namespace fastball::planner
