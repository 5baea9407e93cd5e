// The simulator's contacts held to the reference of model/elastic_ball.h and model/rolling_ball.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/contact_comparison.h"
#include "tests/sim_bullet/test_scene.h"

namespace fastball::sim_bullet {
namespace {

using bench::ContactCase;
using bench::ContactError;

constexpr double kStep = 1e-4;

const std::vector<ContactCase>& cases() {
  static const std::vector<ContactCase> all = bench::contactCases(experiment());
  return all;
}

TEST(ContactReference, HoldsInEveryThrow) {
  for (const ContactCase& contact : cases()) {
    const ContactError error = bench::elasticError(experiment(), simulation(), contact, kStep);
    EXPECT_LT(error.rolling, 1e-4) << contact.name;
    EXPECT_LT(error.force, 0.05) << contact.name;
    EXPECT_LT(error.release, 2e-4) << contact.name;
    // Not for want of anything to get wrong.
    EXPECT_GT(error.distance, 1e-3) << contact.name;
    EXPECT_GT(error.t_release, 0.014) << contact.name;
  }
}

// A step of the simulator is of first order.
TEST(ContactReference, ComesNearerWithHalfTheStep) {
  ContactError at_step, at_half, at_eighth;
  const auto worsen = [](ContactError& worst, const ContactError& error) {
    worst.rolling = std::max(worst.rolling, error.rolling);
    worst.force = std::max(worst.force, error.force);
    worst.release = std::max(worst.release, error.release);
  };
  for (std::size_t i = 0; i < cases().size(); i += 7) {
    worsen(at_step, bench::elasticError(experiment(), simulation(), cases()[i], kStep));
    worsen(at_half, bench::elasticError(experiment(), simulation(), cases()[i], kStep / 2));
    worsen(at_eighth, bench::elasticError(experiment(), simulation(), cases()[i], kStep / 8));
  }
  EXPECT_NEAR(at_step.rolling / at_half.rolling, 2, 0.3);
  EXPECT_NEAR(at_half.rolling / at_eighth.rolling, 4, 0.8);
  EXPECT_GT(at_step.force / at_half.force, 1.7);
  EXPECT_GT(at_half.force / at_eighth.force, 2.9);
  // A whole step either way.
  EXPECT_LT(at_eighth.release, 2 * kStep / 8);
}

// What is left at 1e7 Pa is the bristle's give and the step's.
TEST(ContactReference, AHardBallRollsAsARigidOne) {
  for (const bool groove : {false, true}) {
    double soft = 0, hard = 0;
    for (const ContactCase& contact : cases()) {
      const double modulus = contact.ball.youngs_modulus;
      if (contact.groove != groove || (modulus > 2e4 && modulus < 1e7))
        continue;
      double& worst = modulus < 1e7 ? soft : hard;
      const ContactError error = bench::rigidError(experiment(), simulation(), contact, kStep);
      worst = std::max(worst, error.rolling);
    }
    EXPECT_LT(hard, 5e-5);
    EXPECT_LT(hard, soft / 4);
  }
}

/// Change of a ball's energy by a bounce off the still hand, relative: least and most over random throws.
std::pair<double, double> energyChange(bool groove,
                                       const model::BallParameters& ball,
                                       double step) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> unit(-1, 1);
  ContactCase contact = cases().front();
  contact.groove = groove;
  contact.ball = ball;
  double least = INFINITY, most = -INFINITY;
  for (int i = 0; i < 20; ++i) {
    model::ElasticStart start;
    start.p_FBall = {0, 1e-4 * (1 + unit(random)), 0};
    start.v_FBall = {0.5 * unit(random), -1 + 0.9 * unit(random), 0};
    start.w_F = 20 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    const bench::Bounce bounce = bench::bounceOff(experiment(), simulation(), contact, start, step);
    least = std::min(least, bounce.after / bounce.before - 1);
    most = std::max(most, bounce.after / bounce.before - 1);
  }
  return {least, most};
}

class ContactEnergy : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(On, ContactEnergy, testing::Bool(), [](const auto& p) {
  return p.param ? "Groove" : "OneFinger";
});

TEST_P(ContactEnergy, IsNeverCreated) {
  for (const double modulus : {2e4, 5e5, 1e7}) {
    for (const double damping : {0.0, 0.2}) {
      for (const double friction : {0.0, 0.8}) {
        if (damping == 0 && friction == 0)
          continue;  // below
        model::BallParameters ball = experiment().ball;
        ball.youngs_modulus = modulus;
        ball.damping_ratio = damping;
        ball.friction = friction;
        EXPECT_LT(energyChange(GetParam(), ball, kStep).second, 0) << modulus << ' ' << damping;
      }
    }
  }
}

// Nothing takes energy: what is left is the step's error, of either sign, and of second order.
TEST_P(ContactEnergy, IsKeptByAFrictionlessElasticBall) {
  model::BallParameters ball = experiment().ball;
  ball.damping_ratio = ball.friction = 0;
  for (const double modulus : {2e4, 5e5, 1e7}) {
    ball.youngs_modulus = modulus;
    const auto [least, most] = energyChange(GetParam(), ball, kStep);
    EXPECT_LT(std::max(-least, most), 2e-4) << modulus;
    const auto [least_half, most_half] = energyChange(GetParam(), ball, kStep / 2);
    EXPECT_LT(std::max(-least_half, most_half), std::max(-least, most) / 2) << modulus;
  }
}

}  // namespace
}  // namespace fastball::sim_bullet
