// The planner's throw with the hand server's fingers in the simulator, the arm held to the plan: what the ball does in the hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hand_server/hand_controller.h"
#include "planner/planner.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using testing::HasSubstr;

constexpr double kSettle = 0.6;  // [s], from the scene's start to the plan's

struct Thrown {
  double most_slip = 0;  ///< [m], of the ball along z of H, from the swing's begin to the release
  bool released = false;
  bool touched_again = false;
  std::string notice;  ///< of the hand server, at the command to let go
  double miss = 1;     ///< [m]
  Eigen::Vector3d p_HBall_swing = Eigen::Vector3d::Zero();  ///< [m], when the swing begins
};

/// An experiment and its throw.
struct Throw {
  explicit Throw(const std::array<double, model::kFingers>& azimuth) {
    set_up.hand.azimuth = azimuth;
    planner::PlannerConfig config = planner::loadConfig(kExperimentFile);
    config.hand.azimuth = azimuth;
    plan = std::get<planner::Plan>(
        planner::Planner(config).plan({"robust", set_up.q_rest, set_up.target, 1}));
  }
  hand_server::HandPlan handPlan() const {
    hand_server::HandPlan hand;
    hand.id = 1;
    hand.t_swing = plan.t_swing;
    hand.t_release_command = plan.t_release_command;
    hand.t_release = plan.t_release;
    hand.window = plan.release_window[1] - plan.release_window[0];
    hand.grip_force = plan.grip_force;
    hand.q_wrist = {plan.wrist_roll, plan.wrist_flexion};
    hand.arm = plan.trajectory;
    return hand;
  }
  config::Experiment set_up = experiment();
  planner::Plan plan;
};

class HandThrow : public testing::Test {
 protected:
  static const Throw& asConfigured() {
    static const Throw made(experiment().hand.azimuth);
    return made;
  }
  static Thrown run(const Uncertainty& uncertainty,
                    int64_t seed,
                    const Throw& made = asConfigured()) {
    const planner::Plan& plan = made.plan;
    const model::Arm arm(made.set_up.arm, made.set_up.hand.payload);
    const model::Hand fingers(made.set_up.hand);
    const Eigen::Isometry3d X_TH = fingers.X_TH(plan.wrist_roll, plan.wrist_flexion);
    hand_server::HandController hand(arm, fingers, made.set_up.ball,
                                     hand_server::loadConfig(kExperimentFile));
    EXPECT_TRUE(hand.offerPlan(made.handPlan()));
    EXPECT_TRUE(hand.startThrow({1, 1, std::llround(1e6 * kSettle)}));
    SceneStart start = restStart();
    start.seeds.scene = seed;
    Scene scene(made.set_up, simulation(), uncertainty, start);
    Thrown thrown;
    const auto ticks = std::lround(1e3 * (kSettle + plan.t_release + plan.flight_time + 0.05));
    for (long k = 0; k < ticks; ++k) {
      const double t = 1e-3 * static_cast<double>(k) - kSettle;
      const RobotState& robot = scene.state();
      hand_server::HandSample sample{1000 * k, 1, k, robot.q.hand, robot.qd.hand};
      for (int i = 0; i < model::kFingers; ++i) {
        sample.force[i] = robot.felt[i].normal;
        sample.tangential[i] = robot.felt[i].tangential;
      }
      const auto told = hand.answer(sample).value();
      const model::ArmMotion motion = plan.trajectory.at(t);
      const Eigen::Vector4d kp(8000, 8000, 2000, 5000), kd(250, 250, 22, 70);
      const Eigen::Vector4d tau =
          arm.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm.frictionTorque(motion.qd) +
          kp.cwiseProduct(motion.q - robot.q_arm) + kd.cwiseProduct(motion.qd - robot.qd_arm);
      const Eigen::Vector3d p_HBall =
          (arm.X_WT(robot.q.arm) * X_TH).inverse() * scene.ball().p_WBall;
      if (t < plan.t_swing)
        thrown.p_HBall_swing = p_HBall;
      if (t >= plan.t_swing && t < plan.t_release_command) {
        thrown.most_slip =
            std::max(thrown.most_slip, std::abs(p_HBall.z() - thrown.p_HBall_swing.z()));
        thrown.notice = hand.notice();
      }
      scene.advance(tau, {told.q, told.qd, told.tau, told.kp, told.kd});
      for (const SceneEvent& event : scene.events()) {
        thrown.released |= event.kind == SceneEvent::Kind::kReleased;
        thrown.touched_again |= event.kind == SceneEvent::Kind::kTouched;
        if (event.kind == SceneEvent::Kind::kLanded)
          thrown.miss = event.landing.norm();
      }
    }
    return thrown;
  }
};

TEST_F(HandThrow, LandsWhereThePlannerSaysAndIsNotTouchedAgain) {
  const Thrown thrown = run({}, 1);
  EXPECT_TRUE(thrown.released);
  EXPECT_FALSE(thrown.touched_again);
  EXPECT_LT(thrown.miss, 0.01);
  EXPECT_EQ(thrown.notice, "");
}

TEST_F(HandThrow, LandsThereFromThreeFingersSpacedEvenly) {
  const Throw even({-5 * M_PI / 6, M_PI / 2, -M_PI / 6});
  const Thrown thrown = run({}, 1, even);
  EXPECT_TRUE(thrown.released);
  EXPECT_FALSE(thrown.touched_again);
  EXPECT_LT(thrown.miss, 0.01);
}

TEST_F(HandThrow, DoesNotSlipAtAFrictionOfAHalf) {
  Uncertainty uncertainty;
  const double mu = experiment().ball.friction;
  uncertainty.setUniform(Uncertainty::kThrow, Error::kFriction, 0.5 / mu - 1, 0.5 / mu - 1);
  const Thrown thrown = run(uncertainty, 1);
  EXPECT_LT(thrown.most_slip, 0.5e-3);
  EXPECT_EQ(thrown.notice, "");
}

TEST_F(HandThrow, ASlipIsSaidBeforeTheRelease) {
  Uncertainty uncertainty;
  const double mu = experiment().ball.friction;
  uncertainty.setUniform(Uncertainty::kThrow, Error::kFriction, 0.1 / mu - 1, 0.1 / mu - 1);
  const Thrown thrown = run(uncertainty, 1);
  EXPECT_GT(thrown.most_slip, 0.5e-3);
  EXPECT_THAT(thrown.notice, HasSubstr("the ball slips"));
}

TEST_F(HandThrow, GraspsABallThatLiesOffTheCentre) {
  Uncertainty uncertainty;
  uncertainty.setNormal(Uncertainty::kThrow, Error::kGraspOffset, 0.005);
  int thrown_off_centre = 0;
  for (int64_t seed = 1; seed < 200 && thrown_off_centre < 3; ++seed) {
    const double offset =
        drawErrors(uncertainty, experiment().ball, {0, seed}).ball_offset_H.norm();
    if (offset < 0.009 || offset > 0.010)
      continue;
    ++thrown_off_centre;
    const Thrown thrown = run(uncertainty, seed);
    EXPECT_TRUE(thrown.released) << seed;
    EXPECT_LT(thrown.most_slip, 0.5e-3) << seed;
    EXPECT_LT(thrown.miss, 0.1) << seed;
    EXPECT_EQ(thrown.notice, "") << seed;
  }
  EXPECT_EQ(thrown_off_centre, 3);
}

}  // namespace
}  // namespace fastball::sim_bullet
