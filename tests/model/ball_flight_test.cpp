#include "model/ball_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

constexpr double kGravity = 9.81;

class BallFlight : public ::testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  Eigen::Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  BallState thrown() {
    return {vector(0.5), Eigen::Vector3d(uniform(4, 8), uniform(-1, 1), uniform(-1, 4))};
  }
  /// A plane 2 to 4 m ahead, turned sideways and leaning back; not so far forward that the ball could fall clear of it.
  Target target() {
    Target target;
    target.p_WTarget = Eigen::Vector3d(uniform(2, 4), 0, -0.5);
    target.n_WTarget = Eigen::Vector3d(-1, uniform(-0.5, 0.5), uniform(-0.1, 0.7)).normalized();
    return target;
  }

  const double drag_ = exampleBall().dragPerMetre();
  std::mt19937 random_{1};
};

TEST_F(BallFlight, WithoutDragIsAParabola) {
  for (int i = 0; i < 100; ++i) {
    const BallState start = thrown();
    const double t = i == 0 ? 0 : uniform(1e-6, 1.5);
    const BallState end = fly(start, t, 0, kGravity);
    const Eigen::Vector3d g(0, 0, -kGravity);
    EXPECT_TRUE(end.v_WBall.isApprox(start.v_WBall + t * g, 1e-12));
    EXPECT_LT((end.p_WBall - start.p_WBall - t * start.v_WBall - t * t / 2 * g).norm(), 1e-12);
  }
}

TEST_F(BallFlight, WithoutGravitySlowsAlongALine) {
  // dv/dt = -k v^2: v = v0 / (1 + k v0 t), x = log(1 + k v0 t) / k.
  const BallState end = fly({{0, 0, 0}, {6, 0, 0}}, 0.5, drag_, 0);
  EXPECT_NEAR(end.v_WBall.x(), 6 / (1 + drag_ * 3), 1e-9);
  EXPECT_NEAR(end.p_WBall.x(), std::log(1 + drag_ * 3) / drag_, 1e-9);
  EXPECT_EQ(end.p_WBall.tail<2>().norm(), 0);
}

TEST_F(BallFlight, FoamBallFeelsAQuarterOfGravityAsDrag) {
  EXPECT_NEAR(flightAcceleration({6, 0, 0}, drag_, 0).norm(), 2.4, 0.1);
  EXPECT_EQ(flightAcceleration(Eigen::Vector3d::Zero(), drag_, kGravity),
            Eigen::Vector3d(0, 0, -kGravity));
}

TEST_F(BallFlight, DragTakesEnergy) {
  for (int i = 0; i < 50; ++i) {
    BallState state = thrown();
    const auto energy = [&] {
      return state.v_WBall.squaredNorm() / 2 + kGravity * state.p_WBall.z();
    };
    for (int k = 0; k < 20; ++k) {
      const double before = energy();
      state = fly(state, 0.02, drag_, kGravity);
      EXPECT_LT(energy(), before);
    }
  }
}

TEST_F(BallFlight, StepsAreFineEnough) {
  for (int i = 0; i < 50; ++i) {
    const BallState start = thrown();
    BallState fine = start;
    for (int k = 0; k < 700; ++k)
      fine = fly(fine, 1e-3, drag_, kGravity);
    const BallState whole = fly(start, 0.7, drag_, kGravity);
    EXPECT_LT((whole.p_WBall - fine.p_WBall).norm(), 1e-9);
    EXPECT_LT((whole.v_WBall - fine.v_WBall).norm(), 1e-9);
  }
}

TEST_F(BallFlight, HasItsDerivativesByTheVelocity) {
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 50; ++i) {
    BallState start = thrown();
    if (i == 0)
      start.v_WBall.setZero();
    const double t = i == 1 ? 0 : uniform(1e-6, 1.5);
    const FlightDerivatives d = flyWithDerivatives(start, t, drag_, kGravity);
    const BallState end = fly(start, t, drag_, kGravity);
    EXPECT_LT((d.state.p_WBall - end.p_WBall).norm(), 1e-8);
    EXPECT_LT((d.state.v_WBall - end.v_WBall).norm(), 1e-8);
    for (int k = 0; k < 3; ++k) {
      BallState high = start, low = start;
      high.v_WBall[k] += kStep;
      low.v_WBall[k] -= kStep;
      const BallState a = fly(high, t, drag_, kGravity), b = fly(low, t, drag_, kGravity);
      EXPECT_LT((d.dp_dv.col(k) - (a.p_WBall - b.p_WBall) / (2 * kStep)).norm(), 1e-6);
      EXPECT_LT((d.dv_dv.col(k) - (a.v_WBall - b.v_WBall) / (2 * kStep)).norm(), 1e-6);
    }
  }
}

TEST_F(BallFlight, RunsBackwards) {
  const BallState start = thrown();
  const BallState back = fly(fly(start, 0.3, drag_, kGravity), -0.3, drag_, kGravity);
  EXPECT_LT((back.p_WBall - start.p_WBall).norm(), 1e-9);
}

TEST_F(BallFlight, LandsWhereAParabolaMeetsThePlane) {
  Target net;
  net.p_WTarget = {3, 0, -0.5};
  const auto landing = land({{0, 0.2, 0}, {6, 0.5, 1}}, net, 0, kGravity);
  ASSERT_TRUE(landing);
  EXPECT_NEAR(landing->time, 0.5, 1e-12);
  // The first coordinate points to the right seen from the robot, that is along -y.
  EXPECT_NEAR(landing->landing.x(), -0.45, 1e-12);
  EXPECT_NEAR(landing->landing.y(), 0.5 * 1 - kGravity / 8 + 0.5, 1e-12);
}

TEST_F(BallFlight, LandsOnThePlaneAtTheTimeSaid) {
  for (int i = 0; i < 200; ++i) {
    const BallState start = thrown();
    const Target plane = target();
    const auto landing = land(start, plane, drag_, kGravity);
    ASSERT_TRUE(landing);
    EXPECT_LT(std::abs(plane.distance(landing->state.p_WBall)), 1e-10);
    EXPECT_LT((fly(start, landing->time, drag_, kGravity).p_WBall - landing->state.p_WBall).norm(),
              1e-9);
    EXPECT_LT((plane.planeCoordinates(landing->state.p_WBall) - landing->landing).norm(), 1e-12);
    EXPECT_GT(plane.distance(fly(start, landing->time - 1e-6, drag_, kGravity).p_WBall), 0);
    EXPECT_FALSE(land(start, plane, drag_, kGravity, landing->time - 1e-9));
    EXPECT_TRUE(land(start, plane, drag_, kGravity, landing->time + 1e-9));
  }
}

TEST_F(BallFlight, DoesNotLandFromBehindOrFlyingAway) {
  Target net;
  net.p_WTarget = {3, 0, 0};
  EXPECT_FALSE(land({{0, 0, 0}, {-6, 0, 0}}, net, drag_, kGravity));
  EXPECT_FALSE(land({{0, 0, 0}, {0, 0, 0}}, net, drag_, kGravity));
  EXPECT_FALSE(land({{4, 0, 0}, {-6, 0, 0}}, net, drag_, kGravity));
  EXPECT_FALSE(land({{3, 0, 0}, {6, 0, 0}}, net, drag_, kGravity));
  EXPECT_FALSE(land({{0, 0, 0}, {6, 0, 0}}, net, drag_, kGravity, 0));
}

TEST_F(BallFlight, SeesATouchWithinOneStep) {
  // Thrown up to an almost horizontal plane: the top of the path is 1 um above it, for 0.9 ms.
  Target ceiling;
  ceiling.n_WTarget = Eigen::Vector3d(-1e-9, 0, -1).normalized();
  const double top = 1 / (2 * kGravity);
  ceiling.p_WTarget = {0, 0, top - 1e-6};
  const auto landing = land({{0, 0, 0}, {0, 0, 1}}, ceiling, 0, kGravity);
  ASSERT_TRUE(landing);
  EXPECT_NEAR(landing->time, 1 / kGravity - std::sqrt(2e-6 / kGravity), 1e-9);
  ceiling.p_WTarget = {0, 0, top + 1e-6};
  EXPECT_FALSE(land({{0, 0, 0}, {0, 0, 1}}, ceiling, 0, kGravity));
}

TEST(VelocityToReach, BallArrives) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1), duration(0.05, 1.5), drag(0, 0.1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d from(coordinate(random), coordinate(random), coordinate(random));
    const Eigen::Vector3d to = from + Eigen::Vector3d(3, coordinate(random), coordinate(random));
    const double T = duration(random), k = drag(random);
    const Eigen::Vector3d v = velocityToReach(from, to, T, k, 9.81);
    EXPECT_LT((fly({from, v}, T, k, 9.81).p_WBall - to).norm(), 1e-4) << "T " << T << " k " << k;
    // A guess changes the way to the answer only.
    const Eigen::Vector3d again = velocityToReach(from, to, T, k, 9.81, v * 1.01);
    EXPECT_LT((again - v).norm() * T, 1e-6);
  }
}

TEST(VelocityToReach, WithoutDragItIsTheParabola) {
  const Eigen::Vector3d v = velocityToReach({0, 0, 0}, {3, 0, -0.5}, 0.6, 0, 10);
  EXPECT_NEAR(v.x(), 5, 1e-9);
  EXPECT_NEAR(v.z(), -0.5 / 0.6 + 3, 1e-9);
}

}  // namespace
}  // namespace fastball::model
