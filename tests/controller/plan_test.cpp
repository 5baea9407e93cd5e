// Every fault of a plan is refused with one sentence that names joint, value, limit and time.
#include "controller/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/controller/closed_loop.h"

namespace fastball::controller {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using Samples = std::vector<model::ArmMotion>;

/// The good plan with its samples changed.
Plan changed(const std::function<void(Samples&)>& change) {
  Plan plan = swingPlan(7);
  Samples samples = plan.trajectory.samples();
  change(samples);
  plan.trajectory = model::SampledTrajectory(plan.trajectory.dt(), samples);
  return plan;
}

std::string faultOf(const Plan& plan) {
  return planFault(testArm(), plan).value_or("");
}

/// A plan that goes from kBack to `to` and back in `duration` [s] each way.
Plan excursion(const Eigen::Vector4d& to, double duration) {
  Samples samples = quintic(kBack, to, duration);
  const Samples back = quintic(to, kBack, duration);
  samples.insert(samples.end(), back.begin() + 1, back.end());
  return {7, 0, 0, duration, model::SampledTrajectory(0.01, samples)};
}

TEST(PlanFault, AGoodPlanHasNone) {
  EXPECT_EQ(faultOf(swingPlan()), "");
}

TEST(PlanFault, NotFinite) {
  const Plan plan =
      changed([](Samples& s) { s[30].qdd[2] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_EQ(faultOf(plan), "plan 7: sample 30 is not finite");
}

TEST(PlanFault, NoSamples) {
  EXPECT_EQ(faultOf(Plan{7, 0, 0, 0, {}}), "plan 7: it has 0 samples, at least 2 are needed");
}

TEST(PlanFault, MovingAtAnEnd) {
  EXPECT_THAT(faultOf(changed([](Samples& s) { s.front().qd[1] = 0.1; })),
              AllOf(HasSubstr("joint 2"), HasSubstr("0.1 rad/s"), HasSubstr("first sample")));
  EXPECT_THAT(faultOf(changed([](Samples& s) { s.back().qd[3] = -0.2; })),
              AllOf(HasSubstr("joint 4"), HasSubstr("-0.2 rad/s"), HasSubstr("last sample")));
}

TEST(PlanFault, TimesOutOfOrder) {
  Plan plan = swingPlan(7);
  plan.t_swing = 0.01;
  EXPECT_THAT(faultOf(plan), AllOf(HasSubstr("out of order"), HasSubstr("swing 0.01 s")));
  plan = swingPlan(7);
  plan.t_swing_end = 2;
  EXPECT_THAT(faultOf(plan), HasSubstr("out of order"));
}

TEST(PlanFault, BeyondAJointsRange) {
  EXPECT_THAT(faultOf(excursion({-0.6, 1.3, 0.0, 3.05}, 2)),
              AllOf(HasSubstr("joint 4"), HasSubstr("3.01"), HasSubstr("-0.8127 to 3.013 rad"),
                    HasSubstr("wam4-48v"), HasSubstr("t = ")));
}

TEST(PlanFault, TooFastForAJoint) {
  EXPECT_THAT(faultOf(excursion({1.4, 1.3, 0.0, 1.9}, 1)),
              AllOf(HasSubstr("joint 1 has a speed of"), HasSubstr("its limit is 2.386 rad/s")));
}

TEST(PlanFault, TooFastForTheMotorsThatJoints2And3Share) {
  EXPECT_THAT(faultOf(excursion({-0.6, 0.3, 1.7, 1.9}, 0.75)),
              AllOf(HasSubstr("joints 2 and 3 have a speed of"), HasSubstr("shared motors")));
}

TEST(PlanFault, TooMuchTorque) {
  EXPECT_THAT(faultOf(excursion({-0.5, 1.3, 0.0, 1.9}, 0.08)),
              AllOf(HasSubstr("joint 1 has a torque of"), HasSubstr("its limit is 75.6 N m")));
}

// What lies between the samples counts too: at both samples the arm is at rest, between them it is not.
TEST(PlanFault, BetweenTheSamples) {
  const Samples samples{model::ArmMotion{kBack}, model::ArmMotion{kFront}};
  const Plan plan{7, 0, 0, 0.1, model::SampledTrajectory(0.1, samples)};
  EXPECT_THAT(faultOf(plan), HasSubstr("plan 7: joint"));
}

TEST(StartFault, OnlyNearTheArm) {
  const Plan plan = swingPlan(7);
  EXPECT_FALSE(startFault(plan, kBack, 0.02));
  EXPECT_FALSE(startFault(plan, kBack + 0.019 * Eigen::Vector4d::Unit(2), 0.02));
  EXPECT_EQ(*startFault(plan, kBack + 0.1 * Eigen::Vector4d::Unit(2), 0.02),
            "plan 7: joint 3 starts at 0 rad, but the arm is at 0.1 rad; at most 0.02 rad apart is "
            "allowed");
}

}  // namespace
}  // namespace fastball::controller
