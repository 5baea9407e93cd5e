// One moment of a throw: what its limits and its release say, and how that changes.

#include "bench/throw_limits.h"

#include <gtest/gtest.h>

#include "bench/best_release.h"
#include "tests/bench/free_throws.h"

namespace fastball::bench {
namespace {

model::ArmMotion motionOf(const Eigen::VectorXd& x) {
  return {x.segment<4>(0), x.segment<4>(4), x.segment<4>(8)};
}

Eigen::VectorXd vectorOf(const model::ArmMotion& motion) {
  Eigen::VectorXd x(12);
  x << motion.q, motion.qd, motion.qdd;
  return x;
}

TEST(LimitSlopes, AreTheDerivativesOfTheRows) {
  FreeThrows throws;
  for (const bool differential : {true, false}) {
    model::ArmParameters parameters = throws.config.arm;
    parameters.differential = differential;
    const model::Arm arm(parameters, throws.config.hand.payload);
    FreeThrow task = throws.task();
    task.arm = &arm;
    for (const double share : {0.0, 1e-3, 1.0}) {
      for (int i = 0; i < 20; ++i) {
        const Eigen::VectorXd x = vectorOf(throws.motion(share));
        const LimitSlopes slopes = limitSlopes(task, motionOf(x));
        Eigen::MatrixXd derivative(LimitRows::kCount, 12);
        derivative << slopes.by_q, slopes.by_qd, slopes.by_qdd;
        expectSlope(
            [&](const Eigen::VectorXd& at) {
              return Eigen::VectorXd(limitSlopes(task, motionOf(at)).rows.value);
            },
            x, derivative, 1e-6);
      }
    }
  }
}

TEST(LimitSlopes, AreNeverLessStrictThanTheArm) {
  FreeThrows throws;
  for (const bool hold : {false, true}) {
    CeilingOptions options;
    options.hold_shoulder = hold;
    const FreeThrow task = throws.task(options);
    // Where the friction of a joint that turns round steps, and everywhere else.
    for (const double share : {0.0, 1e-3, 1e-2, 0.1, 1.0}) {
      for (int i = 0; i < 500; ++i) {
        model::ArmMotion motion = throws.motion(share);
        if (hold)
          motion.qd[1] = motion.qdd[1] = 0;
        const Eigen::VectorXd excess =
            limitRows(task, motion).value - limitSlopes(task, motion).rows.value;
        EXPECT_LT(excess.maxCoeff(), 1e-6);
      }
    }
  }
}

TEST(LimitRows, SayWhatTheArmSays) {
  FreeThrows throws;
  const FreeThrow task = throws.task();
  for (int i = 0; i < 200; ++i) {
    const model::ArmMotion motion = throws.motion(1);
    const LimitRows rows = limitRows(task, motion);
    const Eigen::Vector4d tau = throws.arm.inverseDynamics(motion.q, motion.qd, motion.qdd) +
                                throws.arm.frictionTorque(motion.qd);
    EXPECT_NEAR(rows.value.segment<8>(LimitRows::kSpeed).maxCoeff() + 1,
                throws.arm.speedRatio(motion.qd), 1e-12);
    EXPECT_NEAR(rows.value.segment<8>(LimitRows::kTorque).maxCoeff() + 1,
                throws.arm.torqueRatio(tau), 1e-12);
  }
}

TEST(ReleaseRows, HaveTheirDerivatives) {
  FreeThrows throws;
  CeilingOptions options;
  options.across_forearm = true;
  const FreeThrow task = throws.task(options);
  const auto rowsAt = [&](const Eigen::VectorXd& x) {
    return releaseRows(task, x.head<4>(), x.segment<4>(4), x[8]);
  };
  for (int i = 0; i < 20; ++i) {
    const model::ArmMotion motion = throws.motion(1);
    Eigen::VectorXd x(9);
    x << motion.q, motion.qd, throws.uniform(0.1, 1.5);
    const ReleaseRows rows = rowsAt(x);
    Eigen::MatrixXd derivative(6, 9);
    derivative << rows.equal_slope, rows.speed_slope, rows.grazing_slope;
    expectSlope(
        [&](const Eigen::VectorXd& at) {
          const ReleaseRows there = rowsAt(at);
          Eigen::VectorXd values(6);
          values << there.equal, there.speed, there.grazing;
          return values;
        },
        x, derivative, 1e-6);
  }
}

TEST(BestReleases, AreFasterThanAnyRandomOne) {
  FreeThrows throws;
  CeilingOptions anywhere;
  anywhere.must_land = false;
  for (const bool hold : {false, true}) {
    anywhere.hold_shoulder = hold;
    const FreeThrow task = throws.task(anywhere);
    const auto best = bestReleases(task, Merit::kFastest, 30, 1);
    ASSERT_FALSE(best.empty());
    for (int i = 0; i < 20000; ++i) {
      model::ArmMotion motion = throws.motion(1);
      if (hold)
        motion.qd[1] = 0;
      motion.qd /= throws.arm.speedRatio(motion.qd);
      motion.qdd.setZero();
      const LimitRows rows = limitRows(task, motion);
      if (rows.value.head<8>().maxCoeff() > 0 || rows.value.tail<2>().maxCoeff() > 0)
        continue;
      EXPECT_LE(releaseRows(task, motion.q, motion.qd, 0.5).speed, best.front().speed + 1e-6);
    }
  }
}

TEST(BestReleases, LandInTheTargetWithinTheirLimits) {
  FreeThrows throws;
  const FreeThrow task = throws.task();
  for (const Merit merit : {Merit::kFastest, Merit::kEasiest}) {
    const auto releases = bestReleases(task, merit, 20, 3);
    ASSERT_FALSE(releases.empty());
    for (const BestRelease& release : releases) {
      const ReleaseRows rows = releaseRows(task, release.q, release.qd, release.flight_time);
      EXPECT_LT(rows.equal.head<3>().norm(), 1e-5);
      EXPECT_LE(throws.arm.speedRatio(release.qd), 1 + 1e-6);
    }
  }
}

}  // namespace
}  // namespace fastball::bench
