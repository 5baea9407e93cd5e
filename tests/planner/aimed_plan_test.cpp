// Plans for a set-up that adds something to every throw.
#include "planner/aimed_plan.h"

#include <gtest/gtest.h>

#include "tests/planner/default_throw.h"
#include "tests/planner/plan_checks.h"

namespace fastball::planner {
namespace {

class AimedPlan : public testing::Test {
 protected:
  ThrowRequest requestWith(const model::LandingBiases& biases) const {
    ThrowRequest request = example_.request();
    request.strategy = "robust";
    request.biases = biases;
    return request;
  }
  /// Where the plan's ball lands in a set-up with these biases.
  Eigen::Vector2d realLanding(const Plan& plan, const ThrowRequest& request) const {
    const double drag = example_.config.ball.dragPerMetre() * (1 + request.biases[0]);
    model::BallState release = plan.release;
    release.v_WBall += request.biases.segment<3>(1);  // the target lies ahead: axes of the world
    return landingOf(release, request.target, drag) - request.biases.tail<2>();
  }
  DefaultThrow example_;
  Planner planner_{example_.config};
};

TEST_F(AimedPlan, WithoutBiasesIsThePlan) {
  const ThrowRequest request = requestWith(model::LandingBiases::Zero());
  const PlanResult aimed = planAimed(planner_, request), plan = planner_.plan(request);
  EXPECT_EQ(std::get<Plan>(aimed).landing, std::get<Plan>(plan).landing);
}

TEST_F(AimedPlan, LandsInTheCentreInASetUpWithItsBiases) {
  model::LandingBiases biases;
  biases << 0.1, -0.03, 0.02, 0.04, 0.01, -0.005;
  const ThrowRequest request = requestWith(biases);
  const auto plan = std::get<Plan>(planner_.plan(request));
  EXPECT_GT(realLanding(plan, request).norm(), 0.02);
  const auto aimed = std::get<Plan>(planAimed(planner_, request));
  EXPECT_LT(realLanding(aimed, request).norm(), 0.006);
  EXPECT_LT(aimed.landing.norm(), 0.006);
  EXPECT_EQ(limitFault(example_.config, aimed), "");
}

TEST_F(AimedPlan, StaysWithTheThrowFromWhichItsBiasesWereLearned) {
  // Here a little higher only a much faster throw, without a window, is left.
  for (const Eigen::Vector3d& p_WTarget :
       {Eigen::Vector3d(2.99, -1.97, -0.13), Eigen::Vector3d(2.27, -1.06, 0.49)}) {
    ThrowRequest request = example_.requestTo(p_WTarget.x(), p_WTarget.y(), p_WTarget.z(), 1);
    request.strategy = "robust";
    const auto plan = std::get<Plan>(planner_.plan(request));
    request.biases << 0, 0, 0, 0, 0, -0.15;
    const auto aimed = std::get<Plan>(planAimed(planner_, request));
    EXPECT_LT((aimed.release.v_WBall - plan.release.v_WBall).norm(),
              0.1 * plan.release.v_WBall.norm());
    EXPECT_EQ(aimed.release_window[1] > aimed.release_window[0],
              plan.release_window[1] > plan.release_window[0]);
  }
}

TEST_F(AimedPlan, DoesNotFollowAbsurdBiases) {
  model::LandingBiases biases;
  biases << 0, 0, 30, 0, 0, 0;
  const PlanResult aimed = planAimed(planner_, requestWith(biases));
  const Eigen::Vector2d landing =
      landingOf(std::get<Plan>(aimed).release, requestWith(biases).target,
                example_.config.ball.dragPerMetre());
  EXPECT_LE(landing.norm(), 0.31);
}

}  // namespace
}  // namespace fastball::planner
