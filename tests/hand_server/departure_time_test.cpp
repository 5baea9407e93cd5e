// When a finger has lost the ball, from the means of its decaying force over the ticks.
#include "hand_server/departure_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hand_server/ball_watch.h"
#include "hand_server/release_delay.h"
#include "model/contact.h"
#include "tests/hand_server/scripted_hand.h"

namespace fastball::hand_server {
namespace {

/// Force [N] of a finger that leaves the ball at `speed` [m/s], `left` [s] before they would part without damping.
double forceLeft(const model::BallParameters& ball, double speed, double left) {
  model::Contact contact;
  const Eigen::Vector3d n_W = Eigen::Vector3d::UnitZ();
  return contact.step(ball, n_W, speed * left, speed * n_W, 1e-4).norm();
}

/// [s] before they would part without damping, when the force goes to nothing.
double partingBefore(const model::BallParameters& ball, double speed) {
  double low = 0, high = 0.02;
  while (high - low > 1e-9) {
    const double middle = (low + high) / 2;
    (forceLeft(ball, speed, middle) > 0 ? high : low) = middle;
  }
  return high;
}

/// The three readings about the end of the force, which comes `end` [ms] after that of the second.
std::array<ForceReading, 3> readingsOf(const model::BallParameters& ball,
                                       double speed,
                                       double end) {
  constexpr int kSteps = 200;
  std::array<ForceReading, 3> readings;
  const double parting = partingBefore(ball, speed);
  for (int k = 0; k < 3; ++k) {
    readings[k].time = k - 1.0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = readings[k].time - (i + 0.5) / kSteps;
      readings[k].force += forceLeft(ball, speed, parting + 1e-3 * (end - t)) / kSteps;
    }
  }
  return readings;
}

TEST(EndOfForce, IsThatOfTheContactLaw) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  double sum = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    model::BallParameters ball = experiment().ball;
    ball.youngs_modulus = 2e5 * std::pow(5, uniform(engine));
    const double speed = 0.1 + 0.3 * uniform(engine);
    const double end = -0.7 + 1.2 * uniform(engine);
    const double error = endOfForce(readingsOf(ball, speed, end), 0.001) - end;
    EXPECT_LT(std::abs(error), 0.35) << ball.youngs_modulus << " Pa, " << speed << " m/s, " << end;
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / kCases), 0.15) << "[ms]";
}

TEST(EndOfForce, IsFiniteAndNearTheLastReadingWhateverTheForces) {
  for (const double noise : {0.0, 0.01}) {
    for (const auto& force : {std::array{0.0, 0.0, 0.0}, std::array{5.0, 5.0, 5.0},
                              std::array{0.0, 0.0, 9.0}, std::array{1e-9, 1e-9, 0.0}}) {
      const double end = endOfForce({{{-1, force[0]}, {0, force[1]}, {1, force[2]}}}, noise);
      EXPECT_LE(std::abs(end), 1);
    }
  }
}

TEST(BallWatch, ABallThatAFingerBarelyPressesHasNotLeft) {
  constexpr TouchSettings kSettings{0.05, 0.003, 0.01, 0.001};
  BallWatch watch(kSettings);
  int64_t utime = 0;
  const auto feel = [&](double force) { return watch.step(utime += 1000, {0, force, 0}); };
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(feel(4));
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(feel(0.03));
  const int64_t last = utime - 1000;  // with the one after it these are two that feel the ball
  EXPECT_FALSE(feel(0));
  const auto departure = feel(0);
  ASSERT_TRUE(departure) << "3 ms after it";
  EXPECT_EQ(departure->last_touch, last);
  EXPECT_NEAR(static_cast<double>(departure->utime), static_cast<double>(last) - 1000, 1000);
  EXPECT_FALSE(feel(0)) << "said once";
  EXPECT_FALSE(watch.touchedAgain({0, 0.02, 0}));
  EXPECT_EQ(watch.touchedAgain({0, 0, 0.06}), model::kFingerB);
}

TEST(ReleaseDelay, IsLearnedForEachModeByItself) {
  using model::ReleaseMode;
  ReleaseDelay delay;
  EXPECT_EQ(delay.correction(ReleaseMode::kAbrupt), 0);
  for (int throws = 1; throws <= 20; ++throws) {
    delay.learn(ReleaseMode::kAbrupt, 0.010, 0.013);
    EXPECT_NEAR(delay.correction(ReleaseMode::kAbrupt), 0.003 * throws / (throws + 1), 1e-12);
  }
  EXPECT_EQ(delay.correction(ReleaseMode::kSyncRetreat), 0);
  EXPECT_EQ(delay.commandShift(ReleaseMode::kAbrupt, 0.001), -0.001);
  EXPECT_NEAR(delay.commandShift(ReleaseMode::kAbrupt, 0.01), -0.003 * 20 / 21, 1e-12);
}

}  // namespace
}  // namespace fastball::hand_server
