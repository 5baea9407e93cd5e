// The posture that makes good what a ball is off its place in the hand.
#include "controller/grip_correction.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "model/ball_flight.h"
#include "tests/controller/closed_loop.h"

namespace fastball::controller {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kRest = 0.5;  // [s] before the swing
const Plan kPlan = swingPlan(1, kRest);

const Vector3d& place() {
  return experiment().hand.p_HBall;
}

Vector4d change(const Vector3d& offset_H) {
  const GripCorrection correction(testArm(), model::Hand(experiment().hand), experiment().ball);
  return correction.postureChange(kPlan, place() + offset_H);
}

/// The ball after its flight, of an arm that is `dq` off the plan when it lets go of a ball `offset_H` off its place.
model::BallState thrown(const Vector3d& offset_H, const Vector4d& dq) {
  const model::Arm arm = testArm();
  const model::ArmMotion motion = kPlan.trajectory.at(kPlan.t_release);
  const Vector3d p_TBall = model::Hand(experiment().hand).X_TH(kPlan.q_wrist[0], kPlan.q_wrist[1]) *
                           Vector3d(place() + offset_H);
  const Vector4d q = motion.q + dq;
  return model::fly({arm.p_WPoint(q, p_TBall), arm.pointJacobian(q, p_TBall) * motion.qd},
                    kPlan.flight_time, experiment().ball.dragPerMetre(), arm.parameters().gravity);
}

/// [m], by which it passes the place where the planned ball is then.
double miss(const Vector3d& offset_H, const Vector4d& dq) {
  const model::BallState planned = thrown(Vector3d::Zero(), Vector4d::Zero());
  return (thrown(offset_H, dq).p_WBall - planned.p_WBall)
      .cross(planned.v_WBall.normalized())
      .norm();
}

TEST(GripCorrection, BringsTheBallToWhereThePlannedOneComes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-0.004, 0.004);  // [m]
  double before = 0, after = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d offset_H(side(random), side(random), side(random));
    before += miss(offset_H, Vector4d::Zero());
    after += miss(offset_H, change(offset_H));
  }
  EXPECT_LT(after, 0.05 * before);
}

TEST(GripCorrection, IsNothingForABallInItsPlaceAndInProportionToItsOffset) {
  EXPECT_EQ(change(Vector3d::Zero()), Vector4d::Zero());
  const Vector3d offset_H(0.001, -0.002, 0.003);
  EXPECT_LT((change(1e-6 * offset_H) - 1e-6 * change(offset_H)).norm(), 1e-12);
}

TEST(GripCorrection, IsTheSmallestThatDoes) {
  const Vector3d offset_H(0.001, -0.002, 0.003);
  const Vector3d direction = thrown(Vector3d::Zero(), Vector4d::Zero()).v_WBall.normalized();
  Eigen::Matrix<double, 3, 4> by_posture;  // of the place across the flight, by differences
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 4; ++i) {
    const Vector4d step = kStep * Vector4d::Unit(i);
    by_posture.col(i) =
        (thrown(Vector3d::Zero(), step).p_WBall - thrown(Vector3d::Zero(), -step).p_WBall)
            .cross(direction) /
        (2 * kStep);
  }
  const Vector4d found = change(offset_H);
  // What moves the ball only along its flight is no part of it.
  Eigen::FullPivLU<Eigen::Matrix<double, 3, 4>> solver(by_posture);
  solver.setThreshold(1e-6);
  const Eigen::MatrixXd idle = solver.kernel();
  ASSERT_EQ(idle.cols(), 2);
  EXPECT_LT((idle.transpose() * found).norm(), 1e-4 * idle.norm() * found.norm());
}

/// An arm in lockstep that has heard how the ball lies before its plan starts.
class CorrectedThrow : public testing::Test {
 protected:
  static constexpr int64_t kStartTick = 600;

  void SetUp() override {
    ASSERT_TRUE(controller_.offerPlan(kPlan));
    ASSERT_TRUE(controller_.startThrow({1, 1, 1000 * kStartTick}));
    run(kStartTick - 10);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      robot_.tick(controller_.answer({1000 * tick_, 1, tick_, robot_.q, robot_.qd})->tau);
      farthest_ = farthest_.cwiseMax(controller_.status().q_error.cwiseAbs());
    }
  }
  /// [rad], by which the arm is off its plan now.
  Vector4d off() const { return robot_.q - kPlan.trajectory.at(1e-3 * (tick_ - kStartTick)).q; }

  ArmController controller_ = testController();
  SimulatedArm robot_{testArm(), kBack};
  int64_t tick_ = 0;
  Vector4d farthest_ = Vector4d::Zero();  ///< [rad], from where the arm should have been
  Vector3d p_HBall_ = place() + Vector3d(0.001, -0.002, 0.002);
};

TEST_F(CorrectedThrow, TakesThePostureUpBeforeTheSwingAndKeepsToIt) {
  controller_.correctFor(1, 1, p_HBall_);
  run(10);
  EXPECT_LT(off().norm(), 1e-5);
  const Vector4d wanted = change(p_HBall_ - place());
  EXPECT_GT(wanted.norm(), 0.003);
  for (const double t : {0.35, kRest, kPlan.t_release, kPlan.t_swing_end, 2.0}) {
    run(static_cast<int>(kStartTick + 1000 * t - tick_));
    EXPECT_LT((off() - wanted).norm(), 1e-3) << t;
  }
  EXPECT_LT(farthest_.maxCoeff(), 1e-3) << "without a jump";
  EXPECT_EQ(controller_.notice(), "");
}

TEST_F(CorrectedThrow, GoesNoFartherThanItsLimit) {
  controller_.correctFor(1, 1, place() + Vector3d(0, 0, 0.5));
  run(510);
  EXPECT_NEAR(off().cwiseAbs().maxCoeff(), loadConfig(kExperimentPath).grip_correction_max, 1e-4);
  EXPECT_EQ(controller_.status().saturations, 0);
}

TEST_F(CorrectedThrow, HearsNothingOfOtherThrowsAndNothingAfterItsStart) {
  controller_.correctFor(2, 1, p_HBall_);
  controller_.correctFor(1, 2, p_HBall_);
  run(11);
  controller_.correctFor(1, 1, p_HBall_);
  run(500);
  EXPECT_LT(off().norm(), 1e-5);
}

TEST_F(CorrectedThrow, ASwingThatBeginsAtOnceStaysAsPlanned) {
  ArmController controller = testController();
  ASSERT_TRUE(controller.offerPlan(swingPlan(1, 0.2)));
  ASSERT_TRUE(controller.startThrow({1, 1, 1000}));
  SimulatedArm robot{testArm(), kBack};
  for (int64_t tick = 0; tick < 200; ++tick) {
    controller.correctFor(1, 1, p_HBall_);
    robot.tick(controller.answer({1000 * tick, 1, tick, robot.q, robot.qd})->tau);
  }
  EXPECT_LT((robot.q - kBack).norm(), 1e-5);
}

}  // namespace
}  // namespace fastball::controller
