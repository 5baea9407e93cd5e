#include <gtest/gtest.h>

#include <filesystem>

#include "config/arm_file.h"
#include "model/ball_flight.h"
#include "tests/planner/default_throw.h"

// Strategy `robust` at the default target: it does not matter when the ball leaves.
namespace fastball::planner {
namespace {

class RobustPlan : public testing::TestWithParam<const char*> {
 protected:
  RobustPlan() {
    example_.config.arm = config::readArm(config::Section::fromFile(
        std::filesystem::path(FASTBALL_SOURCE_DIR) / "config/arm" / GetParam()));
    ThrowRequest request = example_.request();
    request.strategy = "robust";
    const PlanResult result = Planner(example_.config).plan(request);
    if (const Refusal* refusal = std::get_if<Refusal>(&result))
      throw std::runtime_error(refusal->sentence);
    plan_ = std::get<Plan>(result);
  }
  /// The ball in the hand.
  model::BallState held(double t) const {
    const model::Arm arm(example_.config.arm, example_.config.hand.payload);
    const model::Hand hand(example_.config.hand);
    const Eigen::Vector3d p_TBall =
        hand.X_TH(plan_.wrist_roll, plan_.wrist_flexion) * example_.config.hand.p_HBall;
    const model::ArmMotion motion = plan_.trajectory.at(t);
    return {arm.p_WPoint(motion.q, p_TBall), arm.pointJacobian(motion.q, p_TBall) * motion.qd};
  }

  DefaultThrow example_;
  Plan plan_;
};

TEST_P(RobustPlan, LandingDoesNotMoveWithTheMomentOfRelease) {
  EXPECT_NEAR(plan_.release_window[1] - plan_.release_window[0], 0.04, 1e-9);
  EXPECT_NEAR(plan_.t_release, (plan_.release_window[0] + plan_.release_window[1]) / 2, 5e-3);
  const auto landing = [&](double t) {
    return model::land(held(t), example_.experiment.target, example_.config.ball.dragPerMetre(),
                       example_.config.arm.gravity)
        .value()
        .landing;
  };
  const Eigen::Vector2d first = landing(plan_.release_window[0]);
  for (double t = plan_.release_window[0]; t <= plan_.release_window[1]; t += 1e-3)
    EXPECT_LT((landing(t) - first).norm(), 3e-3) << t;
}

TEST_P(RobustPlan, BallAsTheFingersLetItGoLandsOnTheTarget) {
  EXPECT_LT(plan_.landing.norm(), example_.config.landing_tolerance);
  EXPECT_GT(plan_.release.v_WBall.norm(), 4.8);
  EXPECT_GT(plan_.t_release, plan_.release_window[0]);
  EXPECT_LT(plan_.t_release, plan_.release_window[1]);
}

TEST_P(RobustPlan, ResidualAccelerationIsWhatThePlanSays) {
  const bool is_90v = std::string(GetParam()) == "wam4-90v.yaml";
  // With the speed limits of 48 V no window of this length is a free flight.
  EXPECT_LT(plan_.residual_acceleration, is_90v ? 0.3 : 35);
  const double h = 1e-4;
  for (double t = plan_.release_window[0] + h; t < plan_.release_window[1]; t += 1e-3) {
    const Eigen::Vector3d a = (held(t + h).v_WBall - held(t - h).v_WBall) / (2 * h);
    const Eigen::Vector3d push =
        a - model::flightAcceleration(held(t).v_WBall, example_.config.ball.dragPerMetre(),
                                      example_.config.arm.gravity);
    EXPECT_LT(push.norm(), plan_.residual_acceleration + 0.1);
  }
}

TEST(WindowlessPlan, OutOfReachOfAnyWindowTheFlightIsShortAndDragMattersLittle) {
  const DefaultThrow example;
  const auto plan = [&](const std::string& strategy) {
    ThrowRequest request = example.requestTo(2.66, 1.37, 0.45);
    request.strategy = strategy;
    return std::get<Plan>(Planner(example.config).plan(request));
  };
  const auto movedByDrag = [&](const Plan& thrown) {
    const ThrowRequest request = example.requestTo(2.66, 1.37, 0.45);
    const double share = 0.1;
    return share * model::landingJacobian(thrown.release, request.target, example.config.ball,
                                          example.config.arm.gravity)
                       .col(0)
                       .norm();
  };
  const Plan robust = plan("robust"), paper = plan("paper");
  EXPECT_LT(robust.release_window[1] - robust.release_window[0], 0.01);
  EXPECT_LT(robust.flight_time, 0.7);
  EXPECT_LT(movedByDrag(robust), 0.03) << "[m]";
  EXPECT_GT(movedByDrag(paper), 4 * movedByDrag(robust)) << "the fastest throw is a lob";
}

TEST(ReleasePrediction, AThrowAfterWhichTheHandTouchesTheBallAgainIsNone) {
  const DefaultThrow example;
  ThrowRequest request = example.request();
  request.strategy = "robust";
  const Plan plan = std::get<Plan>(Planner(example.config).plan(request));
  const model::Arm arm(example.config.arm, example.config.hand.payload);
  const WholeMotion motion{plan.trajectory,  plan.t_ready,           plan.t_swing,
                           plan.t_swing_end, plan.release_window[0], 0.04};
  for (const double touched_again : {-1.0, 0.06}) {
    const ReleasePredictor predictor(
        example.config, arm,
        [&](const std::function<model::HandMotion(double)>& hand_at,
            const model::HandSupport& support, model::ReleaseMode mode) {
          model::Departure left = instantDeparture(example.config)(hand_at, support, mode);
          left.touched_again = touched_again;
          return left;
        });
    EXPECT_EQ(predictor
                  .predict(motion, {plan.wrist_roll, plan.wrist_flexion}, request.target,
                           plan.t_release_command)
                  .has_value(),
              touched_again < 0);
  }
}

INSTANTIATE_TEST_SUITE_P(With,
                         RobustPlan,
                         testing::Values("wam4-48v.yaml", "wam4-90v.yaml"),
                         [](const auto& profile) {
                           return std::string(profile.param) == "wam4-48v.yaml" ? "48V" : "90V";
                         });

}  // namespace
}  // namespace fastball::planner
