// The fastest throws: possible ones, no slower than they can be, and none where there is none.

#include "bench/ceiling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/bench/free_throws.h"
#include "tests/planner/plan_checks.h"

namespace fastball::bench {
namespace {

using testing::HasSubstr;

/// What the arm's data sheet and the planner's configuration allow, written out here once more.
void expectPossible(const FreeThrows& throws,
                    const Ceiling& ceiling,
                    const CeilingOptions& options,
                    const model::Target& target) {
  ASSERT_TRUE(ceiling.found);
  const model::ArmParameters& limits = throws.config.arm;
  const double T = ceiling.trajectory.duration(), kOver = 1 + 1e-6;
  const double q2 = ceiling.trajectory.at(0).q[1];
  for (double t = 0; t <= T; t += 1e-4) {
    const model::ArmMotion at = ceiling.trajectory.at(t);
    const Eigen::Vector4d tau =
        throws.arm.inverseDynamics(at.q, at.qd, at.qdd) + throws.arm.frictionTorque(at.qd);
    const Eigen::Array4d speed =
        at.qd.array().abs() / (options.speed_share * limits.qd_max.array());
    const Eigen::Array4d torque =
        tau.array().abs() / (options.torque_share * limits.tau_max.array());
    for (const Eigen::Array4d& share : {speed, torque}) {
      ASSERT_LE(std::max({share[0], share[1] + share[2], share[3]}), kOver) << t;
    }
    ASSERT_GE((at.q - limits.q_min).minCoeff(), limits.position_margin - 1e-6) << t;
    ASSERT_GE((limits.q_max - at.q).minCoeff(), limits.position_margin - 1e-6) << t;
    const Eigen::Vector3d p = throws.arm.p_WPoint(at.q, throws.config.hand.p_HBall);
    ASSERT_GE(p.z(), throws.config.swing.lowest_ball - 1e-6);
    if (p.z() < 0) {
      ASSERT_GE(p.head<2>().norm(), throws.config.swing.body_clearance - 1e-6);
    }
    if (options.hold_shoulder) {
      ASSERT_DOUBLE_EQ(at.q[1], q2);
    }
  }
  for (const double end : {0.0, T})
    EXPECT_LT(ceiling.trajectory.at(end).qd.norm(), 1e-9);
  const model::ArmMotion at = ceiling.trajectory.at(ceiling.t_release);
  const model::BallState ball{throws.arm.p_WPoint(at.q, throws.config.hand.p_HBall),
                              throws.arm.pointJacobian(at.q, throws.config.hand.p_HBall) * at.qd};
  EXPECT_NEAR(ball.v_WBall.norm(), ceiling.release_speed, 1e-9);
  EXPECT_LT(planner::landingOf(ball, target, throws.config.ball.dragPerMetre()).norm(), 1e-3);
}

TEST(CeilingTest, IsAThrowAsFastAsTheSpeedLimitsAllow) {
  const FreeThrows throws;
  double held = 0;
  for (const bool hold : {true, false}) {
    CeilingOptions options;
    options.hold_shoulder = hold;
    const Ceiling fastest = ceiling(throws.config, throws.target, options);
    expectPossible(throws, fastest, options, throws.target);
    EXPECT_LE(fastest.check.violation, 1e-6);
    EXPECT_LE(fastest.release_speed, fastest.bound * (1 + 1e-5));
    EXPECT_GT(fastest.release_speed, fastest.bound * 0.999);
    EXPECT_GT(fastest.release_speed, held);
    held = fastest.release_speed;
  }
}

TEST(CeilingTest, CanLeaveAcrossTheForearm) {
  const FreeThrows throws;
  CeilingOptions options;
  options.across_forearm = true;
  const Ceiling fastest = ceiling(throws.config, throws.target, options);
  expectPossible(throws, fastest, options, throws.target);
  const model::ArmMotion at = fastest.trajectory.at(fastest.t_release);
  const Eigen::Vector3d forearm = throws.arm.X_WT(at.q).linear().col(2);
  EXPECT_NEAR(forearm.dot(fastest.check.release.v_WBall), 0, 1e-6);
}

TEST(CeilingTest, IsTheSameForTheSameSeed) {
  const FreeThrows throws;
  const Ceiling a = ceiling(throws.config, throws.target),
                b = ceiling(throws.config, throws.target);
  EXPECT_EQ(a.release_speed, b.release_speed);
  EXPECT_EQ(a.t_release, b.t_release);
}

TEST(CeilingTest, SinksWithTheSpeedLimits) {
  const FreeThrows throws;
  CeilingOptions options;
  options.speed_share = 0.9;
  const Ceiling slower = ceiling(throws.config, throws.target, options);
  expectPossible(throws, slower, options, throws.target);
  EXPECT_LT(slower.release_speed, 0.98 * ceiling(throws.config, throws.target).release_speed);
}

TEST(CeilingOverTorqueBudget, NeverSinksWithMoreTorque) {
  const FreeThrows throws;
  CeilingOptions options;
  options.hold_shoulder = true;
  options.starts = 2;
  const std::vector<double> shares{1, 0.35, 0.05, 0.3};
  const auto ceilings = ceilingOverTorqueBudget(throws.config, throws.target, options, shares);
  ASSERT_EQ(ceilings.size(), shares.size());
  for (const std::size_t i : {0, 1, 3}) {
    options.torque_share = shares[i];
    expectPossible(throws, ceilings[i], options, throws.target);
  }
  EXPECT_FALSE(ceilings[2].found) << "5 % of the torque do not carry the arm";
  EXPECT_LE(ceilings[3].release_speed, ceilings[1].release_speed);
  EXPECT_LE(ceilings[1].release_speed, ceilings[0].release_speed);
  EXPECT_LT(ceilings[3].release_speed, 0.99 * ceilings[0].release_speed);
}

TEST(Reachable, FindsThrowsToTargetsAllAround) {
  FreeThrows throws;
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    const double distance = throws.uniform(2, 3), azimuth = throws.uniform(-1, 1);
    model::Target target = throws.target;
    target.n_WTarget = -Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
    target.p_WTarget = -distance * target.n_WTarget;
    target.p_WTarget.z() = throws.uniform(-0.8, 0.5);
    const Ceiling any = anyThrow(throws.config, target);
    if (!any.found)
      continue;
    ++found;
    expectPossible(throws, any, {}, target);
  }
  EXPECT_GE(found, 18);
}

TEST(Reachable, NoThrowWhereThereIsNone) {
  const FreeThrows throws;
  EXPECT_TRUE(reachable(throws.config, throws.target));
  model::Target far = throws.target;
  far.p_WTarget.x() = 12;
  EXPECT_FALSE(reachable(throws.config, far));
  model::Target turned_away = throws.target;
  turned_away.n_WTarget = Eigen::Vector3d::UnitX();
  EXPECT_FALSE(reachable(throws.config, turned_away));
  CeilingOptions slow;
  slow.speed_share = 0.5;
  EXPECT_FALSE(reachable(throws.config, throws.target, slow));
  const Ceiling none = ceiling(throws.config, far);
  EXPECT_FALSE(none.found);
  EXPECT_EQ(none.release_speed, 0);
}

TEST(CeilingOptionsTest, AreChecked) {
  const FreeThrows throws;
  const auto refusal = [&](const CeilingOptions& options, const model::Target& target) {
    try {
      ceiling(throws.config, target, options);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  CeilingOptions options;
  options.torque_share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(options, throws.target), HasSubstr("torque limits must be"));
  options = {};
  options.control_points = 3;
  EXPECT_THAT(refusal(options, throws.target), HasSubstr("from 6 to 40, not 3"));
  model::Target target = throws.target;
  target.p_WTarget.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal({}, target), HasSubstr("distance"));
  target = throws.target;
  target.n_WTarget = {0, 0, 1};
  EXPECT_THAT(refusal({}, target), HasSubstr("vertical"));
}

}  // namespace
}  // namespace fastball::bench
