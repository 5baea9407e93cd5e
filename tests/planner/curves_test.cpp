// Base functions with their corners rounded, and the polynomials about them.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "planner/base_curve.h"
#include "planner/polynomial.h"

namespace fastball::planner {
namespace {

using model::BaseValue;

/// Speed and acceleration are the derivatives of the angle, and nothing jumps.
void expectSmooth(const std::function<BaseValue(double)>& curve, double from, double to) {
  constexpr double kH = 1e-5;
  for (double t = from; t < to; t += 1.7e-3) {
    const BaseValue before = curve(t - kH), at = curve(t), after = curve(t + kH);
    EXPECT_NEAR((after.q - before.q) / (2 * kH), at.qd, 1e-5) << "t = " << t;
    EXPECT_NEAR((after.qd - before.qd) / (2 * kH), at.qdd, 0.05) << "t = " << t;
    EXPECT_NEAR(after.qdd, before.qdd, 1.0) << "t = " << t;
  }
}

TEST(SinCurve, BeginsAtRestAndMeetsItsBaseFunction) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const model::SinBase base{1.5 * number(engine), 4 + 2 * number(engine), number(engine),
                              number(engine)};
    const SinCurve curve(base);
    const BaseValue rest = curve.at(curve.begin() - 1);
    EXPECT_EQ(rest.qd, 0);
    EXPECT_EQ(rest.qdd, 0);
    expectSmooth([&](double t) { return curve.at(t); }, curve.begin() - 0.05, base.end() - 0.05);
    const double middle = 0.5 * (base.start() + base.end());
    EXPECT_DOUBLE_EQ(curve.at(middle).q, base.at(middle).q);
    EXPECT_DOUBLE_EQ(curve.at(middle).qd, base.at(middle).qd);
  }
}

TEST(SinCurve, OfNoAmplitudeRests) {
  const SinCurve curve(model::SinBase{0, 3, 0.1, 0.7});
  for (const double t : {-1.0, 0.0, 0.3}) {
    EXPECT_EQ(curve.at(t).q, 0.7);
    EXPECT_EQ(curve.at(t).qd, 0);
  }
}

TEST(ExpCurve, BeginsAtRestAndMeetsItsBaseFunction) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const model::ExpBase base{number(engine), 7 + 3 * number(engine), 0.05 * number(engine),
                              number(engine)};
    const ExpCurve curve(base);
    EXPECT_EQ(curve.at(curve.begin() - 1).qd, 0);
    expectSmooth([&](double t) { return curve.at(t); }, curve.begin() - 0.05, base.t_switch + 0.5);
    for (const double t : {base.t_switch - 0.1, base.t_switch + 0.1}) {
      EXPECT_DOUBLE_EQ(curve.at(t).q, base.at(t).q);
      EXPECT_DOUBLE_EQ(curve.at(t).qd, base.at(t).qd);
    }
  }
}

TEST(Quintic, HasItsEnds) {
  const BaseValue a{0.3, -1, 5}, b{-0.2, 2, -7};
  const BaseValue first = quinticAt(a, b, 0.4, 0), last = quinticAt(a, b, 0.4, 0.4);
  EXPECT_NEAR(first.q, a.q, 1e-12);
  EXPECT_NEAR(first.qd, a.qd, 1e-12);
  EXPECT_NEAR(first.qdd, a.qdd, 1e-12);
  EXPECT_NEAR(last.q, b.q, 1e-12);
  EXPECT_NEAR(last.qd, b.qd, 1e-12);
  EXPECT_NEAR(last.qdd, b.qdd, 1e-11);
  expectSmooth([&](double t) { return quinticAt(a, b, 0.4, t); }, 0.01, 0.39);
}

TEST(Brake, EndsAtRest) {
  const BaseValue from{0.3, 5, -40};
  EXPECT_EQ(brakeAt(from, 0.3, 0).q, from.q);
  EXPECT_EQ(brakeAt(from, 0.3, 0).qd, from.qd);
  EXPECT_EQ(brakeAt(from, 0.3, 0).qdd, from.qdd);
  EXPECT_NEAR(brakeAt(from, 0.3, 0.3).qd, 0, 1e-12);
  EXPECT_NEAR(brakeAt(from, 0.3, 0.3).qdd, 0, 1e-9);
  EXPECT_EQ(brakeAt(from, 0.3, 2).q, brakeAt(from, 0.3, 0.3).q);
  expectSmooth([&](double t) { return brakeAt(from, 0.3, t); }, 0.01, 0.5);
}

}  // namespace
}  // namespace fastball::planner
