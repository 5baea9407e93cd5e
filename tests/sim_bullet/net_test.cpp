// Free flight, the ring, the bag and the floor, and what the judge makes of them.
#include <gtest/gtest.h>

#include "model/ball_flight.h"
#include "sim_bullet/landing_judge.h"
#include "sim_bullet/net_bag.h"
#include "sim_bullet/world.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep = 1e-4;

/// A ball thrown without a hand.
struct Flight {
  explicit Flight(const model::BallState& start) {
    world.setBall({start.p_WBall, Eigen::Matrix3d::Identity(), start.v_WBall, Vector3d::Zero()});
  }
  void run(double duration) {
    for (double end = time + duration - kStep / 2; time < end;) {
      const BallMotion before = world.ball();
      const Vector3d drag =
          parameters.mass * model::flightAcceleration(before.v_WBall, parameters.dragPerMetre(), 0);
      world.addBallForce(drag + bag.force(before), Vector3d::Zero());
      world.step(kStep);
      time += kStep;
      ring_touched = ring_touched || world.touchesRing();
      const BallMotion after = world.ball();
      judge.step({time,
                  kStep,
                  {before.p_WBall, before.v_WBall},
                  {after.p_WBall, after.v_WBall},
                  after.w_WBall,
                  false,
                  {},
                  world.touchesRing(),
                  world.touchesFloor()},
                 &events);
    }
  }
  std::vector<SceneEvent> landings() const {
    std::vector<SceneEvent> found;
    for (const SceneEvent& event : events)
      if (event.kind == SceneEvent::Kind::kLanded)
        found.push_back(event);
    return found;
  }

  const model::BallParameters& parameters = experiment().ball;
  const model::Target& target = experiment().target;
  ArmHand arm_hand{experiment().arm, experiment().hand, model::HandVector::Zero()};
  World world{arm_hand,         parameters,         target,
              simulation().net, simulation().floor, experiment().arm.gravity};
  NetBag bag{target, simulation().net, parameters};
  LandingJudge judge{target, parameters.dragPerMetre(), experiment().arm.gravity};
  std::vector<SceneEvent> events;
  double time = 0;
  bool ring_touched = false;
};

model::Landing expected(const model::BallState& start) {
  return model::land(start, experiment().target, experiment().ball.dragPerMetre(),
                     experiment().arm.gravity)
      .value();
}

/// A throw whose free flight crosses the target plane at `landing`.
model::BallState throwAt(const Vector2d& landing) {
  model::BallState start{{0.6, -0.2, -0.1}, {6, 0.4, 1}};
  for (int i = 0; i < 50; ++i) {
    const Vector2d miss = landing - expected(start).landing;
    start.v_WBall +=
        2 * (miss[0] * experiment().target.rightAxis() + miss[1] * experiment().target.upAxis());
  }
  EXPECT_LT((expected(start).landing - landing).norm(), 1e-6);
  return start;
}

TEST(Net, FreeFlightLandsWhereTheModelSays) {
  for (const Vector2d& landing : {Vector2d(0, 0), Vector2d(0.03, -0.02), Vector2d(-0.3, 0.25)}) {
    const model::BallState start = throwAt(landing);
    Flight flight(start);
    flight.run(1);
    ASSERT_EQ(flight.landings().size(), 1u);
    const SceneEvent event = flight.landings()[0];
    EXPECT_LT((event.landing - landing).norm(), 1e-3);
    EXPECT_NEAR(event.time, expected(start).time, 1e-4);
    EXPECT_LT((event.ball.v_WBall - expected(start).state.v_WBall).norm(), 2e-3);
    EXPECT_FALSE(flight.ring_touched);
  }
}

TEST(Net, TheBagKeepsABallThatComesInThroughTheRing) {
  Flight flight(throwAt({0.02, -0.03}));
  flight.run(4);
  const BallMotion ball = flight.world.ball();
  const double depth = -flight.target.distance(ball.p_WBall);
  EXPECT_GT(depth, 0);
  EXPECT_LT(depth, simulation().net.bag_depth);
  EXPECT_LT(flight.target.planeCoordinates(ball.p_WBall).norm(), flight.target.radius);
  EXPECT_LT(ball.v_WBall.norm(), 0.02);
}

TEST(Net, ABallPastTheRingFliesOn) {
  Flight flight(throwAt({0.4, 0}));
  flight.run(0.8);
  EXPECT_GT(flight.world.ball().v_WBall.x(), 3);
  EXPECT_GT(flight.world.ball().p_WBall.x(),
            flight.target.p_WTarget.x() + simulation().net.bag_depth);
}

// The ball meets the ring before its centre reaches the plane: its landing is that of the flight it was on.
TEST(Net, ATouchOfTheRingDoesNotMoveTheLanding) {
  for (const Vector2d& landing : {Vector2d(0.09, 0), Vector2d(0, -0.1), Vector2d(0.12, 0.02)}) {
    Flight flight(throwAt(landing));
    flight.run(1);
    EXPECT_TRUE(flight.ring_touched);
    ASSERT_EQ(flight.landings().size(), 1u);
    EXPECT_LT((flight.landings()[0].landing - landing).norm(), 1e-3);
  }
}

TEST(Net, ABallThatMeetsTheFloorFirstDoesNotLand) {
  Flight flight({{1, 0, -1}, {2, 0, 0}});
  flight.run(3);
  EXPECT_TRUE(flight.landings().empty());
  EXPECT_NEAR(flight.world.ball().p_WBall.z(), simulation().floor.height + experiment().ball.radius,
              2e-3);
}

}  // namespace
}  // namespace fastball::sim_bullet
