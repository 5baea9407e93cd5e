#include "model/elastic_ball.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/contact.h"
#include "tests/model/hand_paths.h"

namespace fastball::model {
namespace {

class Elastic : public testing::TestWithParam<bool> {
 protected:
  ElasticMotion settledThen(const HandPath& path) {
    return elasticOnFingers(ball_, fingers_, path, settledStart(ball_, fingers_, path, task_),
                            task_);
  }
  BallParameters ball_ = exampleBall();
  FingerPair fingers_ = exampleFingers(GetParam());
  RollingTask task_;
};
INSTANTIATE_TEST_SUITE_P(On, Elastic, testing::Bool(), [](const auto& p) {
  return p.param ? "Groove" : "Plane";
});

/// Pushes evenly, without turning [m/s^2].
SwingPath pushed(double forward) {
  SwingPath path;
  path.push = {0, forward, 0};
  return path;
}

TEST_P(Elastic, StaysWhereItHasSettled) {
  task_.t_end = 0.05;
  task_.gravity = 0;
  ball_.drag_coefficient = 0;
  for (const double modulus : {2e4, 5e5, 1e7}) {
    for (const double forward : {1e-6, 1.0, 60.0}) {
      ball_.youngs_modulus = modulus;
      const ElasticMotion motion = settledThen(pushed(forward));
      EXPECT_FALSE(motion.released);
      const ElasticSample &first = motion.elastic.front(), &last = motion.elastic.back();
      EXPECT_NEAR(first.force_F.y(), ball_.mass * forward, 1e-9);
      EXPECT_LT((last.p_FBall - first.p_FBall).norm(), 1e-9);
      EXPECT_NEAR(last.force_F.y(), ball_.mass * forward, 1e-6);
    }
  }
}

// As E grows with the bristle as stiff as sqrt(E): the ball gives way by y and lags behind its bristle, both as 1 / sqrt(E). The
// release comes near that of the rigid ball as E^(-1/5) only: towards it the load falls as c (t_release - t), and a ball
// under so little load swings as slowly as (m^2 / (E c))^(1/5).
TEST_P(Elastic, BecomesRigidAsItsModulusGrows) {
  ball_.damping_ratio = 0.5;
  const RollingMotion rigid = rollOnFingers(ball_, fingers_, exampleSwing(), task_);
  double distance_before = 0, delay_before = 0;
  for (const double modulus : {1e6, 1e8, 1e10}) {
    ball_.youngs_modulus = modulus;
    ball_.bristle_stiffness = 1e4 * std::sqrt(modulus / 1e6);
    ball_.bristle_damping = 20 * std::pow(modulus / 1e6, 0.25);
    const ElasticMotion motion = settledThen(exampleSwing());
    ASSERT_TRUE(motion.released);
    double distance = 0;
    for (std::size_t k = 0; rigid.samples[k].t < rigid.t_slip - 0.01; ++k)
      distance = std::max(distance,
                          std::abs(motion.elastic[k].p_FBall.x() - rigid.samples[k].p_FBall.x()));
    EXPECT_LT(distance, 4e-4);
    if (distance_before > 0) {
      EXPECT_NEAR(distance_before / distance, 10, 2.5) << modulus;
    }
    distance_before = distance;
    // In a groove the fingers' rigid friction, and with it the last of the way, is not determined.
    const double delay = motion.t_release - rigid.t_release;
    EXPECT_LT(std::abs(delay), 2e-3);
    if (delay_before > 0 && !GetParam()) {
      EXPECT_NEAR(delay_before / delay, std::pow(100, 0.2), 0.1) << modulus;
    }
    delay_before = delay;
  }
}

/// What the contact has taken out of the motion: never less than nothing, and never given back.
void expectOnlyDissipation(const ElasticMotion& motion, const char* what, int i) {
  double taken = 0;
  for (const ElasticSample& s : motion.elastic) {
    const double now = motion.elastic.front().stored - s.stored - s.work;
    ASSERT_GE(now, taken - 1e-8) << what << " " << i << ", t = " << s.t;
    taken = now;
  }
}

TEST_P(Elastic, ContactNeverCreatesEnergyInASwing) {
  std::mt19937 random(4);
  std::uniform_real_distribution<> unit(0, 1);
  for (int i = 0; i < 20; ++i) {
    ball_.youngs_modulus = 2e4 * std::pow(500, unit(random));
    ball_.damping_ratio = i % 4 == 0 ? 0 : unit(random);
    ball_.friction = unit(random);
    expectOnlyDissipation(settledThen(randomSwing(random)), "swing", i);
  }
}

TEST_P(Elastic, ABallThrownAtAStillHandKeepsOrLosesItsEnergy) {
  std::mt19937 random(6);
  std::uniform_real_distribution<> unit(-1, 1);
  task_.gravity = 0;
  ball_.drag_coefficient = 0;
  for (int i = 0; i < 20; ++i) {
    ball_.youngs_modulus = i % 2 == 0 ? 5e5 : 2e4;
    ball_.damping_ratio = i % 4 < 2 ? 0 : 0.3;
    ElasticStart start;
    start.p_FBall = {0, 1e-3, 0};
    start.v_FBall = {unit(random), -1.5 + unit(random), 0.3 * unit(random)};
    start.w_F = 30 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    const ElasticMotion motion = elasticOnFingers(ball_, fingers_, pushed(0), start, task_);
    expectOnlyDissipation(motion, "bounce", i);
    ASSERT_TRUE(motion.released);
    const auto energy = [&](const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
      return ball_.mass / 2 * v.squaredNorm() + ball_.inertia() / 2 * w.squaredNorm();
    };
    EXPECT_LT(energy(motion.ball.v_WBall, motion.w_WBall), energy(start.v_FBall, start.w_F));
    EXPECT_GT(motion.ball.v_WBall.y(), 0);
  }
}

TEST_P(Elastic, AnUndampedBallBouncesStraightBackAtItsSpeed) {
  task_.gravity = 0;
  ball_.drag_coefficient = 0;
  ball_.damping_ratio = 0;
  ball_.friction = 0;
  for (const double speed : {1e-3, 1.0}) {
    ElasticStart start;
    start.v_FBall = {0, -speed, 0};
    const ElasticMotion motion = elasticOnFingers(ball_, fingers_, pushed(0), start, task_);
    ASSERT_TRUE(motion.released);
    EXPECT_NEAR(motion.ball.v_WBall.y(), speed, 1e-6 * speed);
  }
}

TEST_P(Elastic, IsUnmovedByAHandThatDoesNotPush) {
  const ElasticMotion motion = settledThen(pushed(-20));
  EXPECT_TRUE(motion.released);
  EXPECT_EQ(motion.t_release, 0);
  EXPECT_EQ(motion.ball.v_WBall.norm(), 0);
}

TEST_P(Elastic, ComesOffAtTheFingertips) {
  task_.fingertip = 0.005;
  const ElasticMotion off = settledThen(exampleSwing());
  EXPECT_TRUE(off.released && off.rolled_off);
  EXPECT_NEAR(off.elastic.back().p_FBall.x(), 0.005, 1e-12);
  EXPECT_EQ(off.elastic.back().t, off.t_release);
}

TEST_P(Elastic, RefusesALoadThatSinksThroughAndNumbersThatMakeNoSense) {
  ball_.youngs_modulus = 1e3;
  EXPECT_THROW(settledThen(pushed(200)), std::invalid_argument);
  const auto refused = [&](double BallParameters::*number, double value) {
    BallParameters ball = exampleBall();
    ball.*number = value;
    EXPECT_THROW(elasticOnFingers(ball, fingers_, pushed(1), {}, task_), std::invalid_argument);
  };
  refused(&BallParameters::youngs_modulus, 0);
  refused(&BallParameters::damping_ratio, -0.1);
  refused(&BallParameters::bristle_stiffness, NAN);
  refused(&BallParameters::bristle_damping, 0);
  refused(&BallParameters::mass, -1);
}

// Softer: later and faster, as the paper has it (section 5). The rigid ball leaves when the hand stops pushing.
TEST(ElasticRelease, IsLaterAndFasterTheSofterTheBall) {
  const FingerPair fingers = exampleFingers(true);
  BallParameters ball = exampleBall();
  SwingPath path = exampleSwing();
  path.swing = {5.2, 45, -3000};
  double time = rollOnFingers(ball, fingers, path, {}).t_release, speed = 0;
  for (const double modulus : {1e6, 1e5, 2e4}) {
    ball.youngs_modulus = modulus;
    const ElasticMotion motion =
        elasticOnFingers(ball, fingers, path, settledStart(ball, fingers, path, {}), {});
    ASSERT_TRUE(motion.released);
    double fastest = 0;
    for (const ElasticSample& s : motion.elastic)
      if (s.t <= motion.t_release)
        fastest = std::max(fastest, s.v_FBall.y());
    EXPECT_GT(motion.t_release, time);
    EXPECT_GT(fastest, speed);
    time = motion.t_release;
    speed = fastest;
  }
}

}  // namespace
}  // namespace fastball::model
