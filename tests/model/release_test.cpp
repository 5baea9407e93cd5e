#include "model/release.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "model/contact.h"
#include "model/grasp.h"
#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

/// The place of the ball moves along x of the world at 6 m/s with `acceleration` [m/s^2] while the hand turns about it at
/// `turn` [rad/s] about z. A sidearm throw: the forearm points along -y of the world.
std::function<HandMotion(double)> sidearm(double acceleration, double turn = 0) {
  return [=](double t) {
    Eigen::Matrix3d R_WH;
    R_WH.col(1) = Eigen::Vector3d::UnitX();
    R_WH.col(2) = -Eigen::Vector3d::UnitY();
    R_WH.col(0) = R_WH.col(1).cross(R_WH.col(2));
    HandMotion hand;
    hand.X_WH.setIdentity();
    hand.X_WH.linear() = Eigen::AngleAxisd(turn * t, Eigen::Vector3d::UnitZ()) * R_WH;
    const Eigen::Vector3d arm = hand.X_WH.linear() * exampleHand().p_HBall;
    hand.w_WH = turn * Eigen::Vector3d::UnitZ();
    hand.dw_WH.setZero();
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    hand.X_WH.translation() = (6 * t + acceleration * t * t / 2) * x - arm;
    hand.v_WH = (6 + acceleration * t) * x - hand.w_WH.cross(arm);
    hand.a_WH = acceleration * x - hand.w_WH.cross(hand.w_WH.cross(arm));
    return hand;
  };
}

class Release : public ::testing::Test {
 protected:
  Release() {
    ball_.drag_coefficient = 0;  // so that free motion is known
  }
  Departure predict(const std::function<HandMotion(double)>& hand_at, double time_step = 1e-4) {
    return predictDeparture(ball_, hand_, command_, hand_at, gravity_, nullptr, time_step);
  }

  BallParameters ball_ = exampleBall();
  Hand hand_{exampleHand()};
  ReleaseCommand command_{6, ReleaseMode::kAbrupt, exampleRelease()};
  double gravity_ = 9.81;
};

TEST_F(Release, TakesAFewMillisecondsFromTheElasticBall) {
  const Departure departure = predict(sidearm(-40));
  ASSERT_TRUE(departure.departed);
  EXPECT_GT(departure.time, 4e-3);
  EXPECT_LT(departure.time, 10e-3);
  // The stored energy of the grip kicks it forward out of the hand.
  const double hand_speed = 6 - 40 * departure.time;
  EXPECT_GT(departure.ball.v_WBall.x(), hand_speed + 0.2);
  EXPECT_LT(departure.ball.v_WBall.x(), hand_speed + 0.6);
}

TEST_F(Release, ASofterBallLeavesLaterAndFaster) {
  double time = 0, speed = 0;
  for (const double modulus : {1e7, 1e6, 5e5, 1e5}) {
    ball_.youngs_modulus = modulus;
    const Departure departure = predict(sidearm(-40));
    ASSERT_TRUE(departure.departed);
    const double relative = departure.ball.v_WBall.x() - (6 - 40 * departure.time);
    EXPECT_GT(departure.time, time);
    EXPECT_GT(relative, speed);
    time = departure.time;
    speed = relative;
  }
}

TEST_F(Release, DampingMakesItEarlierAndSlower) {
  double time = 1, speed = 100;
  for (const double zeta : {0.0, 0.1, 0.3, 0.6}) {
    ball_.damping_ratio = zeta;
    const Departure departure = predict(sidearm(-40));
    const double relative = departure.ball.v_WBall.x() - (6 - 40 * departure.time);
    EXPECT_LT(departure.time, time);
    EXPECT_LT(relative, speed);
    time = departure.time;
    speed = relative;
  }
}

TEST_F(Release, AHardBallLeavesAtOnceWhenTheHandFallsBack) {
  // Eq. (24): alpha'_y < g'_y, here with gravity off.
  gravity_ = 0;
  ball_.youngs_modulus = 1e8;
  command_.grip_force = 0.01;
  command_.ideal_drives = true;
  const Departure back = predict(sidearm(-40), 1e-6);
  ASSERT_TRUE(back.departed);
  EXPECT_LT(back.time, 1e-4);
  EXPECT_NEAR(back.ball.v_WBall.x(), 6, 0.01);
  const Departure forward = predict(sidearm(40), 1e-5);
  EXPECT_FALSE(forward.departed) << "the fingers still push it";
  EXPECT_NEAR(forward.ball.v_WBall.x(), 6 + 40 * 0.1, 0.01);
}

TEST_F(Release, WithoutGripAHandInUniformMotionHandsOverItsVelocity) {
  gravity_ = 0;
  command_.grip_force = 0;
  const Departure straight = predict(sidearm(0));
  ASSERT_TRUE(straight.departed);
  EXPECT_EQ(straight.time, 0);
  EXPECT_LT((straight.ball.v_WBall - Eigen::Vector3d(6, 0, 0)).norm(), 1e-12);
  EXPECT_LT(straight.w_WBall.norm(), 1e-12);
}

TEST_F(Release, ALightGripHandsOverVelocityAndSpin) {
  gravity_ = 0;
  command_.grip_force = 0.01;
  const Departure turning = predict(sidearm(0, 10));
  ASSERT_TRUE(turning.departed);
  EXPECT_LT((turning.ball.v_WBall - Eigen::Vector3d(6, 0, 0)).norm(), 0.02);
  EXPECT_NEAR(turning.w_WBall.z(), 10, 0.5);
}

TEST_F(Release, WithoutLossesTheGripEnergyBecomesSpeed) {
  gravity_ = 0;
  ball_.damping_ratio = 0;
  ball_.friction = 0;
  command_.ideal_drives = true;
  for (const double grip : {0.1, 2.0, 6.0, 12.0}) {
    command_.grip_force = grip;
    const FingerGrasp rear = grasp(ball_, hand_, grip).fingers[kFingerA];
    const double energy = 2 * elasticEnergy(ball_, rear.deformation);
    const Departure departure = predict(sidearm(0), 1e-6);
    ASSERT_TRUE(departure.departed);
    const double kick = std::sqrt(2 * energy / ball_.mass);
    EXPECT_NEAR(departure.ball.v_WBall.x(), 6 + kick, 0.003 * kick);
    EXPECT_LT(departure.ball.v_WBall.tail<2>().norm(), 1e-4);
  }
}

TEST_F(Release, RollsInTheGrooveOfTheTwoFingers) {
  // Pushed forward the ball stays on both fingers, and a hand that then accelerates backwards along its z axis lets it roll
  // without slip towards the fingertips. With the normals at 30 degrees to y the rolling height is h = (a - y) cos(30 deg), and
  // z'' = drive / (1 + I / (m h^2)); the paper's 5/7 is that of a flat finger.
  gravity_ = 0;
  ball_.youngs_modulus = 1e5;  // 2 mm of deformation in the fingers
  command_.grip_force = 0.5;
  command_.ideal_drives = true;
  const double forward = 60, drive = 5, time = 0.05;
  const auto pushed = [=](double t) {
    HandMotion hand = sidearm(forward)(t);
    if (t < 0)
      return hand;
    const Eigen::Vector3d z = hand.X_WH.linear().col(2);
    hand.X_WH.translation() -= drive * t * t / 2 * z;
    hand.v_WH -= drive * t * z;
    hand.a_WH -= drive * z;
    return hand;
  };
  const Departure rolling =
      predictDeparture(ball_, hand_, command_, pushed, gravity_, nullptr, 2e-5, time);
  EXPECT_FALSE(rolling.departed);
  const double z = (pushed(time).X_WH.inverse() * rolling.ball.p_WBall).z() - 0.15;
  const double y = deformation(ball_, ball_.mass * forward / (2 * std::cos(M_PI / 6)));
  const double height = (0.05 - y) * std::cos(M_PI / 6);
  const double factor = 1 / (1 + 0.4 * 0.05 * 0.05 / (height * height));
  EXPECT_NEAR(z, factor * drive * time * time / 2, 2e-5);
  EXPECT_GT(std::abs(z - 5.0 / 7 * drive * time * time / 2), 3e-4);
  EXPECT_NEAR(rolling.w_WBall.norm(), factor * drive * time / height, 0.05);
}

TEST_F(Release, IsInBalanceAtTheCommand) {
  // Even without damping of its own the ball does not swing in the grip of a hand that slows down.
  ball_.damping_ratio = 0;
  const auto relative = [&](double lag) {
    HandParameters parameters = exampleHand();
    parameters.actuator_lag = lag;
    const Departure departure =
        predictDeparture(ball_, Hand(parameters), command_, sidearm(-40), gravity_);
    return departure.ball.v_WBall.x() - (6 - 40 * departure.time);
  };
  for (const double lag : {1e-3, 1.5e-3, 2e-3})
    EXPECT_NEAR(relative(lag), relative(5e-4), 3e-2);
}

TEST_F(Release, ASynchronousRetreatLeavesTheBallAloneHoweverHardItIs) {
  // A hand that flies the ball's own path.
  const auto falling = [](double t) {
    HandMotion hand = sidearm(0)(t);
    const Eigen::Vector3d g(0, 0, -9.81);
    hand.X_WH.translation() += t * t / 2 * g;
    hand.v_WH += t * g;
    hand.a_WH += g;
    return hand;
  };
  const auto kick = [&](ReleaseMode mode) {
    command_.mode = mode;
    const Departure left = predict(falling);
    EXPECT_TRUE(left.departed);
    const Eigen::Vector3d v = left.ball.v_WBall - falling(left.time).v_WH;
    // The arc of the opening fingers draws the ball along the hand's z axis a little.
    EXPECT_LT(v.tail<2>().norm(), 0.06);
    return std::abs(v.x());
  };
  for (const double modulus : {3e5, 5e5, 1e6}) {
    // The hand holds it by its force, wherever it finds the surface: the grasp is that of this ball.
    ball_.youngs_modulus = modulus;
    EXPECT_GT(kick(ReleaseMode::kAbrupt), 0.2) << modulus;
    EXPECT_LT(kick(ReleaseMode::kThumbFade), 0.2) << modulus;
    EXPECT_LT(kick(ReleaseMode::kSyncRetreat), 0.02) << modulus;
  }
}

TEST_F(Release, ThreeFingersSpacedEvenlyLetGoByARetreatButNotByAThumb) {
  HandParameters parameters = exampleHand();
  parameters.azimuth = {-5 * M_PI / 6, M_PI / 2, -M_PI / 6};
  const Hand even(parameters);
  const GraspGeometry held = grasp(ball_, even, 6);
  for (const FingerGrasp& finger : held.fingers)
    EXPECT_NEAR(finger.force, 6, 1e-9);
  command_.mode = ReleaseMode::kSyncRetreat;
  gravity_ = 0;
  const Departure left = predictDeparture(ball_, even, command_, sidearm(0), gravity_);
  EXPECT_TRUE(left.departed);
  EXPECT_LT((left.ball.v_WBall - Eigen::Vector3d(6, 0, 0)).norm(), 0.06);
  command_.mode = ReleaseMode::kAbrupt;
  ball_.friction =
      1;  // its cone is wider than the 30 degrees between a finger and the line of A and B
  EXPECT_FALSE(predictDeparture(ball_, even, command_, sidearm(0), gravity_).departed);
}

TEST_F(Release, SaysWhenTheHandRunsIntoTheBallAgain) {
  const auto watched = [&](double brake) {
    return predictDeparture(ball_, hand_, command_, sidearm(-brake), gravity_, nullptr, 1e-4, 0.1,
                            0.15);
  };
  const Departure clear = watched(40);
  EXPECT_TRUE(clear.departed);
  EXPECT_LT(clear.touched_again, 0);
  // A hand that goes on accelerating catches up.
  const Departure caught = watched(-8);
  ASSERT_TRUE(caught.departed);
  EXPECT_GT(caught.touched_again, caught.time);
  EXPECT_LT(caught.touched_again, caught.time + 0.15);
}

TEST_F(Release, AnArmThatGivesWayIsPushedBackByTheThumb) {
  // A hand that nothing but its inertia holds: 0.8 kg that may move along x of the world, the way of the throw.
  HandSupport support;
  support.M *= 1e9;
  support.M(0, 0) = 0.8;
  support.J(0, 0) = 1;
  const auto straight = sidearm(0);
  gravity_ = 0;
  const Departure free = predictDeparture(ball_, hand_, command_, straight, gravity_, &support);
  const Departure firm = predict(straight);
  // The thumb (0.1 kg) leaves with some metres per second.
  EXPECT_LT(free.ball.v_WBall.x(), firm.ball.v_WBall.x() - 0.05);
  EXPECT_GT(free.ball.v_WBall.x(), firm.ball.v_WBall.x() - 0.3);
}

TEST_F(Release, AHandThatIsNotToldToOpenKeepsTheBall) {
  command_.mode = ReleaseMode::kSyncRetreat;
  command_.settings.relax_time = 10;
  const Departure held = predict(sidearm(-40, 5));
  EXPECT_FALSE(held.departed);
  // Held by friction against gravity and all: less than a millimetre from its place.
  const HandMotion hand = sidearm(-40, 5)(0.1);
  const Eigen::Vector3d place = hand.X_WH.inverse() * held.ball.p_WBall;
  EXPECT_LT((place - exampleHand().p_HBall).norm(), 1e-3);
}

TEST_F(Release, ASwingTooFastForTheGripLosesTheBallBefore) {
  command_.grip_force = 0.5;
  const auto spun = [](double t) {
    HandMotion hand = sidearm(0, 60)(t);
    // About the shoulder instead of about the ball: 0.5 m further in, 60 rad/s.
    hand.X_WH.translation() += hand.X_WH.linear() * Eigen::Vector3d(0, 0, 0.5);
    hand.v_WH = Eigen::Vector3d(6, 0, 0) +
                hand.w_WH.cross(hand.X_WH.translation() - Eigen::Vector3d(6 * t, 0, 0));
    return hand;
  };
  const Departure lost = predict(spun);
  EXPECT_TRUE(lost.departed);
  EXPECT_LT(lost.time, 0);
}

TEST_F(Release, ConvergesWithTheTimeStep) {
  const Departure fine = predict(sidearm(-40, 10), 5e-6);
  double error_before = 1;
  for (const double step : {2e-4, 1e-4, 2.5e-5}) {
    const Departure coarse = predict(sidearm(-40, 10), step);
    const double error = (coarse.ball.v_WBall - fine.ball.v_WBall).norm();
    EXPECT_LT(error, 130 * step) << step;
    EXPECT_LT(error, error_before);
    EXPECT_NEAR(coarse.time, fine.time, 2.5 * step);
    error_before = error;
  }
}

TEST_F(Release, RefusesWhatCannotBe) {
  command_.grip_force = 1e4;
  EXPECT_THROW(predict(sidearm(0)), std::invalid_argument);
  command_.grip_force = 6;
  EXPECT_THROW(predict(sidearm(0), 0), std::invalid_argument);
  ball_.mass = 0;
  EXPECT_THROW(predict(sidearm(0)), std::invalid_argument);
}

}  // namespace
}  // namespace fastball::model
