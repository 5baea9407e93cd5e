#include "model/hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "model/contact.h"
#include "model/grasp.h"
#include "tests/model/example_hand.h"

namespace fastball::model {
namespace {

constexpr std::array<Finger, kFingers> kAllFingers = {kFingerA, kThumb, kFingerB};

class HandTest : public ::testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  HandVector randomPosture() {
    HandVector q;
    for (int i = 0; i < kHandJoints; ++i)
      q[i] = uniform(-1.5, 1.5);
    return q;
  }
  const Hand hand_{exampleHand()};
  std::mt19937 random_{5};
};

TEST_F(HandTest, PhalangesKeepTheirLengthsAndHangTogether) {
  for (int i = 0; i < 100; ++i) {
    const HandVector q = i == 0 ? HandVector::Zero() : randomPosture();
    for (const Finger finger : kAllFingers) {
      const auto [proximal, distal] = hand_.phalanges(finger, q);
      EXPECT_NEAR((proximal.p_end - proximal.p_start).norm(), 0.06, 1e-12);
      EXPECT_NEAR((distal.p_end - distal.p_start).norm(), 0.05, 1e-12);
      EXPECT_EQ(proximal.p_end, distal.p_start);
      EXPECT_NEAR(proximal.p_start.head<2>().norm(), 0.045, 1e-12);
      EXPECT_NEAR(proximal.p_start.z(), 0.0665, 1e-12);
    }
  }
}

TEST_F(HandTest, PositiveFlexionClosesPositiveSpreadTurnsAboutZ) {
  const HandVector zero = HandVector::Zero();
  for (const Finger finger : kAllFingers) {
    const int proximal = Hand::proximalJoint(finger);
    HandVector q = zero;
    q[proximal] = 0.1;
    const Eigen::Vector3d tip = hand_.phalanges(finger, q)[1].p_end;
    EXPECT_NEAR(tip.head<2>().norm(), 0.045 - 0.11 * std::sin(0.1), 1e-12);
    q = zero;
    q[proximal + 1] = 0.1;
    EXPECT_LT(hand_.phalanges(finger, q)[1].p_end.head<2>().norm(), 0.045);
    if (finger == kThumb)
      continue;
    q[proximal - 1] = 0.2;  // the bent finger's tip moves about z through its base
    const Eigen::Vector3d base = hand_.phalanges(finger, q)[0].p_start;
    HandVector unspread = q;
    unspread[proximal - 1] = 0;
    const Eigen::Vector3d before = hand_.phalanges(finger, unspread)[1].p_end - base;
    const Eigen::Vector3d after = hand_.phalanges(finger, q)[1].p_end - base;
    EXPECT_LT((after - Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * before).norm(), 1e-12);
  }
}

TEST_F(HandTest, WristRollsAboutZThenFlexesAboutX) {
  EXPECT_TRUE(hand_.X_TH(0, 0).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_LT((hand_.X_TH(M_PI / 2, 0) * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
            1e-12);
  const Eigen::Vector3d y = hand_.X_TH(M_PI / 2, M_PI / 2) * Eigen::Vector3d::UnitY();
  EXPECT_LT((y - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  const Eigen::Vector3d z = hand_.X_TH(M_PI / 2, M_PI / 2) * Eigen::Vector3d::UnitZ();
  EXPECT_LT((z - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST_F(HandTest, ParallelFingerHoldsItsDistalPhalanxAtTheDistance) {
  for (const double distance : {-0.015, 0.0, 0.045, 0.045 + 1e-12, 0.058, 0.0999, 0.105}) {
    const HandVector q = hand_.posture(0.1, -0.2, {distance, distance, distance});
    EXPECT_EQ(q[kWristRoll], 0.1);
    EXPECT_EQ(q[kWristFlexion], -0.2);
    for (const Finger finger : kAllFingers) {
      const Segment distal = hand_.phalanges(finger, q)[1];
      const double azimuth = hand_.parameters().azimuth[finger];
      const Eigen::Vector2d expected(distance * std::cos(azimuth), distance * std::sin(azimuth));
      EXPECT_LT((distal.p_start.head<2>() - expected).norm(), 1e-9);
      EXPECT_LT((distal.p_end.head<2>() - expected).norm(), 1e-9);
      EXPECT_NEAR(distal.p_end.z() - distal.p_start.z(), 0.05, 1e-9);
    }
  }
}

TEST_F(HandTest, ParallelFingerRefusesWhatItCannotReach) {
  for (const double distance : {-0.016, 0.106, std::nan("")})
    EXPECT_THROW(hand_.parallelFinger(distance), std::invalid_argument);
  try {
    hand_.parallelFinger(0.2);
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("0.2 m"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("-0.015 to 0.105 m"));
  }
}

TEST_F(HandTest, FingerTorqueDoesTheWorkOfTheForce) {
  const double h = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const HandVector q = randomPosture();
    const Eigen::Vector3d force(uniform(-10, 10), uniform(-10, 10), uniform(-10, 10));
    for (const Finger finger : kAllFingers) {
      const double part = uniform(0, 1);
      const auto point = [&](const HandVector& joints) -> Eigen::Vector3d {
        const Segment distal = hand_.phalanges(finger, joints)[1];
        return distal.p_start + part * (distal.p_end - distal.p_start);
      };
      const Eigen::Vector3d torque = hand_.fingerTorque(finger, q, point(q), force);
      const int first = Hand::proximalJoint(finger) - 1;
      for (int k = finger == kThumb ? 1 : 0; k < 3; ++k) {
        HandVector plus = q, minus = q;
        plus[first + k] += h;
        minus[first + k] -= h;
        EXPECT_NEAR(torque[k], force.dot(point(plus) - point(minus)) / (2 * h), 1e-8);
      }
    }
    EXPECT_EQ(hand_.fingerTorque(kThumb, q, Eigen::Vector3d::Ones(), force)[0], 0);
  }
}

TEST_F(HandTest, GraspBalancesTheBall) {
  const BallParameters ball = exampleBall();
  for (const double grip : {0.0, 1e-6, 3.0, 6.0, 12.0}) {
    const GraspGeometry held = grasp(ball, hand_, grip);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const FingerGrasp& finger : held.fingers) {
      sum += finger.force * finger.n_H;
      EXPECT_NEAR(elasticForce(ball, finger.deformation), finger.force, 1e-9);
    }
    EXPECT_LT(sum.norm(), 1e-12);
    EXPECT_EQ(held.fingers[kThumb].force, grip);
    EXPECT_NEAR(held.fingers[kFingerA].force, grip / (2 * std::cos(M_PI / 6)), 1e-9);
    EXPECT_NEAR(held.fingers[kFingerB].force, held.fingers[kFingerA].force, 1e-9);
    EXPECT_LT(held.fingers[kThumb].n_H.y(), 0) << "the thumb presses backwards";
  }
}

TEST_F(HandTest, GraspPutsTheFingersOnTheBall) {
  const BallParameters ball = exampleBall();
  const GraspGeometry held = grasp(ball, hand_, 6);
  for (const Finger i : kAllFingers) {
    const FingerGrasp& finger = held.fingers[i];
    const Segment distal = hand_.phalanges(i, held.q)[1];
    EXPECT_LT(distal.p_start.z(), 0.15);
    EXPECT_GT(distal.p_end.z(), 0.15);
    const Eigen::Vector3d axis(distal.p_start.x(), distal.p_start.y(), 0.15);
    EXPECT_LT((axis + 0.01 * finger.n_H - finger.p_H).norm(), 1e-12) << "on the finger's surface";
    EXPECT_NEAR((finger.p_H - hand_.parameters().p_HBall).norm(), 0.05 - finger.deformation, 1e-12);
    EXPECT_GT(finger.torque[1], 0) << "positive torque closes";
    EXPECT_NEAR(finger.torque[0], 0, 1e-12) << "no turning about the base";
    // Lever arms of a force across the parallel distal phalanx.
    EXPECT_NEAR(finger.torque[2], finger.force * (0.15 - distal.p_start.z()), 1e-12);
    EXPECT_NEAR(finger.torque[1], finger.force * (0.15 - 0.0665), 1e-12);
  }
}

TEST_F(HandTest, GraspRefusesWhatCannotHold) {
  BallParameters ball = exampleBall();
  EXPECT_THROW(grasp(ball, hand_, -1), std::invalid_argument);
  EXPECT_THROW(grasp(ball, hand_, 1e4), std::invalid_argument);
  HandParameters parameters = exampleHand();
  parameters.azimuth[kThumb] = -M_PI / 2;
  EXPECT_THROW(grasp(ball, Hand(parameters), 6), std::invalid_argument) << "thumb behind the ball";
  parameters = exampleHand();
  parameters.azimuth[kFingerB] = parameters.azimuth[kFingerA];
  EXPECT_THROW(grasp(ball, Hand(parameters), 6), std::invalid_argument) << "A and B in one place";
  parameters = exampleHand();
  parameters.p_HBall.x() = 0.01;
  EXPECT_THROW(grasp(ball, Hand(parameters), 6), std::invalid_argument) << "ball off the axis";
  parameters = exampleHand();
  parameters.p_HBall.z() = 0.12;
  EXPECT_THROW(grasp(ball, Hand(parameters), 6), std::invalid_argument) << "at the proximal links";
  ball.radius = 0.15;
  EXPECT_THROW(grasp(ball, hand_, 6), std::invalid_argument) << "ball too large";
}

}  // namespace
}  // namespace fastball::model
