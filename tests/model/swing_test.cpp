#include "model/swing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "config/experiment.h"
#include "model/arm.h"

namespace fastball::model {
namespace {

template <typename Base>
void expectDerivatives(const Base& base, double t) {
  const double h = 1e-5;
  const BaseValue before = base.at(t - h), at = base.at(t), after = base.at(t + h);
  EXPECT_NEAR(at.qd, (after.q - before.q) / (2 * h), 1e-6 * (1 + std::abs(at.qd))) << t;
  EXPECT_NEAR(at.qdd, (after.qd - before.qd) / (2 * h), 1e-6 * (1 + std::abs(at.qdd))) << t;
}

TEST(SinBase, MovesBetweenItsRests) {
  for (const double alpha : {0.8, -0.8, 1e-9, 0.0}) {
    const SinBase base{alpha, 5, 0.3, 0.2};
    EXPECT_NEAR(base.end() - base.start(), M_PI / 5, 1e-12);
    for (const double t : {base.start() - 1, base.start()})
      EXPECT_NEAR(base.at(t).q, 0.2 - alpha, 1e-12);
    for (const double t : {base.end(), base.end() + 1})
      EXPECT_NEAR(base.at(t).q, 0.2 + alpha, 1e-12);
    for (const double t : {base.start(), base.end()}) {
      EXPECT_NEAR(base.at(t - 1e-9).qd, 0, 1e-6);
      EXPECT_NEAR(base.at(t + 1e-9).qd, 0, 1e-6);
    }
    for (const double part : {0.01, 0.2, 0.5, 0.7, 0.99})
      expectDerivatives(base, base.start() + part * (base.end() - base.start()));
    EXPECT_NEAR(base.at(-0.3 / 5).qd, 5 * alpha, 1e-12) << "fastest in the middle";
  }
}

TEST(ExpBase, GrowsToItsSwitchAndSettlesAfterIt) {
  for (const double amplitude : {0.3, -0.3, 1e-9, 0.0}) {
    const ExpBase base{amplitude, 8, 0.26, 0.1};
    for (const double t : {-1.0, 0.0, 0.2, 0.259, 0.261, 0.3, 1.0})
      expectDerivatives(base, t);
    EXPECT_NEAR(base.at(0.26 - 1e-12).q, base.at(0.26 + 1e-12).q, 1e-10);
    EXPECT_NEAR(base.at(0.26 - 1e-12).qd, base.at(0.26 + 1e-12).qd, 1e-9);
    EXPECT_NEAR(base.at(0.26 - 1e-12).qdd, -base.at(0.26 + 1e-12).qdd, 1e-8);
    EXPECT_NEAR(base.at(-100).q, 0.1, 1e-12);
    EXPECT_NEAR(base.at(100).q, 0.1 + 2 * amplitude, 1e-12);
    EXPECT_EQ(base.at(100).qd, 0);
  }
}

/// Angles that move with constant third derivative, and the WAM joints along them.
struct SwingPath {
  SwingAngles start;
  Eigen::Vector3d jerk;
  double gamma;
  int sign;

  SwingAngles at(double t) const {
    SwingAngles s;
    s.q = start.q + t * start.qd + t * t / 2 * start.qdd + t * t * t / 6 * jerk;
    s.qd = start.qd + t * start.qdd + t * t / 2 * jerk;
    s.qdd = start.qdd + t * jerk;
    return s;
  }
  WamMotion wam(double t, double near) const { return wamFromSwing(at(t), gamma, sign, near); }
};

class AnalogousSwing : public ::testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  Eigen::Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  SwingPath path(int i) {
    return {
        {vector(1.5), vector(8), vector(60)}, vector(300), uniform(0.2, 1.5), i % 2 == 0 ? 1 : -1};
  }
  std::mt19937 random_{4};
};

TEST_F(AnalogousSwing, JointVelocitiesAndAccelerationsAreDerivatives) {
  const double h = 1e-6;
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const SwingPath swing = path(i);
    const WamMotion at = swing.wam(0, 0);
    if (std::abs(at.q[3]) < 0.05 || std::abs(at.q[3]) > 3.09)
      continue;  // near the straight elbow differences say nothing
    const WamMotion before = swing.wam(-h, at.q[2]), after = swing.wam(h, at.q[2]);
    const Vector4 qd = (after.q - before.q) / (2 * h), qdd = (after.qd - before.qd) / (2 * h);
    EXPECT_LT((at.qd - qd).norm(), 1e-5 * (1 + qd.norm()));
    EXPECT_LT((at.qdd - qdd).norm(), 1e-5 * (1 + qdd.norm()));
    ++checked;
  }
  EXPECT_GT(checked, 400);
}

TEST_F(AnalogousSwing, PointsTheForearmOfTheArm) {
  const Arm arm(config::loadExperiment(FASTBALL_SOURCE_DIR "/config/experiment.yaml").arm);
  for (int i = 0; i < 500; ++i) {
    const SwingPath swing = path(i);
    const WamMotion wam = swing.wam(0, 0);
    const Eigen::Vector3d& q = swing.start.q;
    const double polar = swing.gamma + q[1], azimuth = q[0] + q[2];
    const Eigen::Vector3d forearm(std::sin(polar) * std::cos(azimuth),
                                  std::sin(polar) * std::sin(azimuth), std::cos(polar));
    EXPECT_LT((arm.X_WT(wam.q).linear().col(2) - forearm).norm(), 1e-12);
    // The forearm turns as its direction does.
    const Eigen::Vector3d w = arm.rotationJacobian(wam.q) * wam.qd;
    const double h = 1e-6;
    const Eigen::Vector3d moved = arm.X_WT(swing.wam(h, wam.q[2]).q).linear().col(2) -
                                  arm.X_WT(swing.wam(-h, wam.q[2]).q).linear().col(2);
    if (std::abs(wam.q[3]) > 0.05) {
      EXPECT_LT((w.cross(forearm) - moved / (2 * h)).norm(), 1e-6 * (1 + w.norm()));
    }
    EXPECT_EQ(wam.q[0], q[0]);
    EXPECT_EQ(wam.q[1], swing.gamma);
    EXPECT_GE(swing.sign * wam.q[3], 0) << "elbow on the wrong side";
  }
}

TEST_F(AnalogousSwing, Joint3IsTheOneNearestToTheOldOne) {
  for (const double near : {-30.0, -3.0, 0.0, 3.0, 30.0}) {
    for (int i = 0; i < 50; ++i) {
      const SwingPath swing = path(i);
      const WamMotion wam = swing.wam(0, near);
      EXPECT_LE(std::abs(wam.q[2] - near), M_PI + 1e-9);
      EXPECT_NEAR(std::sin(wam.q[2]), std::sin(swing.wam(0, 0).q[2]), 1e-9);
    }
  }
}

TEST_F(AnalogousSwing, StaysFiniteAtAndNearTheStraightElbow) {
  for (const double offset : {0.0, 1e-300, 1e-15, 1e-9, 1e-8, 1e-4}) {
    for (const double polar : {0.0, M_PI}) {
      SwingAngles swing;
      swing.q << 0.3, polar + offset, 0;
      swing.qd << 5, 3, 2;
      swing.qdd << 50, 30, 20;
      const WamMotion wam = wamFromSwing(swing, 0.7, 1, 1.2);
      EXPECT_TRUE(wam.q.allFinite() && wam.qd.allFinite() && wam.qdd.allFinite()) << offset;
    }
  }
  SwingAngles straight;
  straight.qd << 0, 3, 0;
  const WamMotion wam = wamFromSwing(straight, 0.7, 1, 1.2);
  EXPECT_EQ(wam.q[2], 1.2);
  EXPECT_NEAR(wam.q[3], 0, 1e-9);
  EXPECT_NEAR(wam.qd[3], 3, 1e-9);
}

/// The WAM's motion for the angles z = (q1, q2, q3, gamma) with their rates.
struct MovingAngles {
  Vector4 z, zd, zdd;

  SwingAngles swing() const { return {z.head<3>(), zd.head<3>(), zdd.head<3>()}; }
  BaseValue gamma() const { return {z[3], zd[3], zdd[3]}; }
  WamMotion wam(int sign, double near) const { return wamFromSwing(swing(), gamma(), sign, near); }
};

TEST_F(AnalogousSwing, WithAMovingUpperArmHasVelocitiesAndAccelerations) {
  const double h = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Vector4 z(uniform(-1, 1), uniform(-1.5, 1.5), uniform(-1.5, 1.5), uniform(-1.5, 1.5));
    const Vector4 zd = 5 * Vector4::Random(), zdd = 50 * Vector4::Random();
    const auto at = [&](double t) {
      return MovingAngles{z + t * zd + t * t / 2 * zdd, zd + t * zdd, zdd}.wam(1, 0);
    };
    const WamMotion now = at(0);
    if (now.q[3] < 0.05 || now.q[3] > 3.09)
      continue;
    EXPECT_EQ(now.qd[1], zd[3]);
    EXPECT_LT((now.qd - (at(h).q - at(-h).q) / (2 * h)).norm(), 1e-5 * (1 + now.qd.norm()));
    EXPECT_LT((now.qdd - (at(h).qd - at(-h).qd) / (2 * h)).norm(), 1e-5 * (1 + now.qdd.norm()));
  }
}

TEST_F(AnalogousSwing, HasItsDerivativesToNearTheStraightElbow) {
  for (const double bend : {1.0, 0.3, 0.03, 0.003}) {
    for (int i = 0; i < 50; ++i) {
      // The forearm stands off the upper arm by about the bend.
      MovingAngles at;
      at.z << uniform(-1, 1), bend * uniform(0.5, 1), bend * uniform(-1, 1), uniform(0.2, 1.5);
      at.zd << 0, 5 * Eigen::Vector3d::Random();
      at.zdd << 0, 50 * Eigen::Vector3d::Random();
      const int sign = i % 2 == 0 ? 1 : -1;
      const WamDerivatives d = wamDerivatives(at.swing(), at.gamma(), sign, 0);
      const WamMotion same = at.wam(sign, 0);
      EXPECT_EQ(d.motion.q, same.q);
      EXPECT_EQ(d.motion.qdd, same.qdd);
      for (int k = 0; k < 4; ++k) {
        const auto difference = [&](Vector4 MovingAngles::*part) {
          // Of second order in the rates: there any step is right.
          const double step = part == &MovingAngles::z ? 1e-4 * std::abs(same.q[3]) : 1.0;
          MovingAngles high = at, low = at;
          (high.*part)[k] += step;
          (low.*part)[k] -= step;
          const WamMotion a = high.wam(sign, same.q[2]), b = low.wam(sign, same.q[2]);
          return WamMotion{(a.q - b.q) / (2 * step), (a.qd - b.qd) / (2 * step),
                           (a.qdd - b.qdd) / (2 * step)};
        };
        const WamMotion by_z = difference(&MovingAngles::z), by_zd = difference(&MovingAngles::zd),
                        by_zdd = difference(&MovingAngles::zdd);
        const auto near = [](const Vector4& value, const Vector4& expected) {
          EXPECT_LT((value - expected).norm(), 1e-4 * (1 + expected.norm()));
        };
        near(d.F.col(k), by_z.q);
        near(d.Fd.col(k), by_z.qd);
        near(d.Fdd.col(k), by_z.qdd);
        near(d.F.col(k), by_zd.qd);
        near(2 * d.Fd.col(k), by_zd.qdd);
        near(d.F.col(k), by_zdd.qdd);
      }
    }
  }
}

TEST_F(AnalogousSwing, HasFiniteDerivativesInTheStraightElbow) {
  for (const double offset : {0.0, 1e-300, 1e-15, 1e-9}) {
    SwingAngles swing;
    swing.q << 0.3, offset, 0;
    swing.qd << 5, 3, 2;
    const WamDerivatives d = wamDerivatives(swing, {0.7, 1, 0}, 1, 1.2);
    EXPECT_TRUE(d.F.allFinite() && d.Fd.allFinite() && d.Fdd.allFinite()) << offset;
  }
}

}  // namespace
}  // namespace fastball::model
