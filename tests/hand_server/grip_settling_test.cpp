// Fingers find a ball that lies off the centre, of any stiffness.
#include "hand_server/grip_settling.h"

#include <gtest/gtest.h>

#include <random>

#include "model/contact.h"
#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

TEST(GripSettling, EachFingerEndsWithItsShareOfTheGrip) {
  const HandServerConfig config = loadConfig(kExperimentPath);
  const model::Hand hand = testHand();
  const model::GraspGeometry planned = model::grasp(experiment().ball, hand, 6);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.007, 0.007), decade(std::log(2e5), std::log(1e6));
  for (int round = 0; round < 50; ++round) {
    model::BallParameters ball = experiment().ball;
    ball.youngs_modulus = std::exp(decade(random));
    const Eigen::Vector2d p_HBall(place(random), place(random));
    GripSettling settling(planned, experiment().ball, hand.parameters(), config.settle_constant);
    FingerForces force{};
    model::HandVector q;
    const auto feel = [&] {
      q = planned.q;
      settling.apply(q);
      for (int i = 0; i < model::kFingers; ++i) {
        const model::Segment distal = hand.phalanges(static_cast<model::Finger>(i), q)[1];
        const double y = ball.radius + hand.parameters().finger_radius -
                         (p_HBall - distal.p_start.head<2>()).norm();
        force[i] = model::elasticForce(ball, y);
      }
    };
    for (int k = 0; 1e-3 * k < config.settle_time; ++k) {
      feel();
      settling.step(force, false, 1e-3);
    }
    feel();
    for (int i = 0; i < model::kFingers; ++i)
      // A ball of half the stiffness is followed at half the pace.
      EXPECT_NEAR(force[i], planned.fingers[i].force, 0.15 * planned.fingers[i].force)
          << p_HBall.transpose() << ", E = " << ball.youngs_modulus;
    EXPECT_EQ(settling.settled().q, q);
  }
}

TEST(GripSettling, AFingerThatStillClosesOnlyGivesWay) {
  const model::GraspGeometry planned = model::grasp(experiment().ball, testHand(), 6);
  GripSettling settling(planned, experiment().ball, experiment().hand, 0.015);
  settling.step({0, 20, 0}, true, 1e-3);
  const model::GraspGeometry now = settling.settled();
  EXPECT_EQ(now.fingers[model::kFingerA].distance, planned.fingers[model::kFingerA].distance);
  EXPECT_GT(now.fingers[model::kThumb].distance, planned.fingers[model::kThumb].distance);
}

}  // namespace
}  // namespace fastball::hand_server
