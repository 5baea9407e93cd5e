// Base functions with their corners rounded, their derivatives, and the polynomials about them.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "planner/base_curve.h"
#include "planner/follow_through.h"
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
    EXPECT_NEAR((after.qd - before.qd) / (2 * kH), at.qdd, 1e-4) << "t = " << t;
    EXPECT_NEAR(after.qdd, before.qdd, 1.0) << "t = " << t;
  }
}

class Shape : public testing::TestWithParam<ShapeValue (*)(double)> {};

INSTANTIATE_TEST_SUITE_P(Of, Shape, testing::Values(&sinShape, &expShape), [](const auto& test) {
  return test.index == 0 ? "Sin" : "Exp";
});

TEST_P(Shape, HasThreeContinuousDerivatives) {
  constexpr double kH = 1e-6;
  for (double phase = -5; phase < 1.5; phase += 1.31e-4) {
    const ShapeValue a = GetParam()(phase - kH), b = GetParam()(phase), c = GetParam()(phase + kH);
    EXPECT_NEAR((c.s - a.s) / (2 * kH), b.s1, 1e-8) << phase;
    EXPECT_NEAR((c.s1 - a.s1) / (2 * kH), b.s2, 1e-8) << phase;
    EXPECT_NEAR((c.s2 - a.s2) / (2 * kH), b.s3, 1e-3) << phase;
    EXPECT_NEAR(a.s3, c.s3, 2e-3) << phase;
  }
}

TEST_P(Shape, RestsFirstAndNeverTurnsBack) {
  EXPECT_EQ(GetParam()(-6).s1, 0);
  EXPECT_EQ(GetParam()(-6).s2, 0);
  for (double phase = -5; phase < 1.5; phase += 1e-3)
    EXPECT_GE(GetParam()(phase).s1, 0) << phase;
}

TEST(BaseCurve, MeetsItsSin) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const model::SinBase base{1.5 * number(engine), 4 + 2 * number(engine), number(engine),
                              number(engine)};
    const BaseCurve curve(base);
    EXPECT_EQ(curve.at(curve.begin() - 1).qd, 0);
    EXPECT_NEAR(curve.at(curve.begin()).qdd, 0, 1e-15);
    EXPECT_NE(curve.at(curve.begin() + 1e-3).qd, 0);
    expectSmooth([&](double t) { return curve.at(t); }, curve.begin() - 0.05, base.end());
    const double middle = 0.5 * (base.start() + base.end());
    EXPECT_NEAR(curve.at(middle).q, base.at(middle).q, 1e-14);
    EXPECT_NEAR(curve.at(middle).qd, base.at(middle).qd, 1e-14);
  }
}

TEST(BaseCurve, MeetsItsExponential) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const model::ExpBase base{number(engine), 7 + 3 * number(engine), 0.05 * number(engine),
                              number(engine)};
    const BaseCurve curve(base);
    EXPECT_EQ(curve.at(curve.begin() - 1).qd, 0);
    expectSmooth([&](double t) { return curve.at(t); }, curve.begin() - 0.05, base.t_switch + 0.5);
    for (const double t : {base.t_switch - 0.15, base.t_switch + 0.15}) {
      EXPECT_NEAR(curve.at(t).q, base.at(t).q, 1e-14);
      EXPECT_NEAR(curve.at(t).qd, base.at(t).qd, 1e-13);
    }
  }
}

TEST(BaseCurve, OfNoAmplitudeRests) {
  const BaseCurve curve(model::SinBase{0, 3, 0.1, 0.7});
  for (const double t : {-1.0, 0.0, 0.3}) {
    EXPECT_EQ(curve.at(t).q, 0.7);
    EXPECT_EQ(curve.at(t).qd, 0);
  }
}

using Parameters = Eigen::Vector4d;

BaseCurve curveOf(bool exponential, const Parameters& p) {
  return exponential ? BaseCurve(model::ExpBase{p[0], p[1], p[2], p[3]})
                     : BaseCurve(model::SinBase{p[0], p[1], p[2], p[3]});
}

/// By central differences at one time.
void expectDerivatives(bool exponential, const Parameters& p, double t) {
  constexpr double kH = 1e-6;
  const BaseCurve::Derivatives d = curveOf(exponential, p).derivativesAt(t);
  const BaseValue value = curveOf(exponential, p).at(t);
  EXPECT_EQ(d.value.q, value.q);
  EXPECT_EQ(d.value.qd, value.qd);
  EXPECT_EQ(d.value.qdd, value.qdd);
  for (int k = 0; k < 4; ++k) {
    const Parameters step = kH * Parameters::Unit(k);
    const BaseValue high = curveOf(exponential, p + step).at(t),
                    low = curveOf(exponential, p - step).at(t);
    EXPECT_NEAR(d.dq[k], (high.q - low.q) / (2 * kH), 1e-7) << k;
    EXPECT_NEAR(d.dqd[k], (high.qd - low.qd) / (2 * kH), 1e-6 * (1 + std::abs(d.dqd[k]))) << k;
    // At a corner the jerk has a kink, whose effect is of the order of the step.
    EXPECT_NEAR(d.dqdd[k], (high.qdd - low.qdd) / (2 * kH), 2e-3 * (5 + std::abs(d.dqdd[k]))) << k;
  }
}

TEST(BaseCurve, HasItsDerivativesAtAndAroundItsCorners) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> number(-1, 1);
  // Phases of all corners of both shapes.
  const double sin_entry = -M_PI / 2 + 0.35;
  for (int i = 0; i < 20; ++i) {
    for (const bool exponential : {false, true}) {
      Parameters p(number(engine), 6 + 3 * number(engine), 0.05 * number(engine), number(engine));
      if (i == 0)
        p[0] = 0;
      const double zero = exponential ? p[2] : -p[2] / p[1];
      for (const double corner :
           {-4.0, -2.0, -0.3, 0.0, 0.3, sin_entry, sin_entry - 2 * std::tan(0.35)}) {
        for (const double off : {-0.3, -1e-3, 0.0, 1e-3, 0.3})
          expectDerivatives(exponential, p, zero + (corner + off) / p[1]);
      }
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

TEST(FollowThrough, HandsDerivativesBackToItsBegin) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Eigen::Vector4d::NullaryExpr([&] { return number(engine); }); };
  const FollowThrough follow{0.05, {0.35, 0.3, 0.25, 0.2}};
  for (const double t : {0.0, 1e-9, 0.1, 0.22, 0.4}) {
    const MotionGradient g{vector(), vector(), vector()};
    const model::ArmMotion from{vector(), 4 * vector(), 40 * vector()};
    const model::ArmMotion step{vector(), vector(), vector()};
    const auto number_at = [&](double h) {
      const model::ArmMotion at =
          follow.braked({from.q + h * step.q, from.qd + h * step.qd, from.qdd + h * step.qdd}, t);
      return g.q.dot(at.q) + g.qd.dot(at.qd) + g.qdd.dot(at.qdd);
    };
    const MotionGradient before = follow.beforeBraking(g, t);
    // Linear: any step is exact.
    EXPECT_NEAR(before.q.dot(step.q) + before.qd.dot(step.qd) + before.qdd.dot(step.qdd),
                (number_at(1) - number_at(-1)) / 2, 1e-12);
  }
}

}  // namespace
}  // namespace fastball::planner
