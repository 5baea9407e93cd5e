#include "planner/base_curve.h"

#include <Eigen/LU>
#include <cmath>

namespace fastball::planner {
namespace {

// Phases at which the entries from rest meet their base function.
constexpr double kSinEntry = -M_PI / 2 + 0.35;  // the speed there is a third of its peak
constexpr double kExpEntry = -2.0;              // e-folds: the speed there is 14 % of its peak
constexpr double kTurn =
    0.3;  // half the phase in which the exponential's acceleration changes sign

/// Rest, then a rise whose speed is a quintic from u^3 on: it meets a base function with speed, acceleration and jerk. It lasts
/// as long as a rise of constant jerk to that speed and acceleration would.
class Entry {
 public:
  Entry(double phase, const ShapeValue& met) : end_(phase), duration_(2 * met.s1 / met.s2) {
    const double v = met.s1, a = met.s2 * duration_, j = met.s3 * duration_ * duration_;
    c3_ = 10 * v - 4 * a + 0.5 * j;
    c4_ = -15 * v + 7 * a - j;
    c5_ = 6 * v - 3 * a + 0.5 * j;
    rest_ = met.s - duration_ * (c3_ / 4 + c4_ / 5 + c5_ / 6);
  }
  double begin() const { return end_ - duration_; }
  double end() const { return end_; }
  ShapeValue at(double phase) const {
    if (phase <= begin())
      return {rest_, 0, 0, 0};
    const double u = (phase - begin()) / duration_, u2 = u * u;
    ShapeValue value;
    value.s = rest_ + duration_ * u2 * u2 * (c3_ / 4 + u * (c4_ / 5 + u * c5_ / 6));
    value.s1 = u2 * u * (c3_ + u * (c4_ + u * c5_));
    value.s2 = u2 * (3 * c3_ + u * (4 * c4_ + u * 5 * c5_)) / duration_;
    value.s3 = u * (6 * c3_ + u * (12 * c4_ + u * 20 * c5_)) / (duration_ * duration_);
    return value;
  }

 private:
  double end_, duration_, rest_, c3_, c4_, c5_;
};

const Entry& sinEntry() {
  static const Entry entry(kSinEntry, {std::sin(kSinEntry), std::cos(kSinEntry),
                                       -std::sin(kSinEntry), -std::cos(kSinEntry)});
  return entry;
}

const Entry& expEntry() {
  const double e = std::exp(kExpEntry);
  static const Entry entry(kExpEntry, {e, e, e, e});
  return entry;
}

/// Coefficients of u, u^3, u^5, u^7: about phase 0 the shape less 1 is odd and meets 1 - e^-u at u
/// = kTurn with three derivatives.
Eigen::Vector4d turnCoefficients() {
  const double T = kTurn, e = std::exp(-T);
  Eigen::Matrix4d A;
  for (int k = 0; k < 4; ++k) {
    const double n = 2 * k + 1;
    A.col(k) << std::pow(T, n), n * std::pow(T, n - 1), n * (n - 1) * std::pow(T, n - 2),
        n * (n - 1) * (n - 2) * std::pow(T, n - 3);
  }
  return A.fullPivLu().solve(Eigen::Vector4d(1 - e, e, -e, e));
}

ShapeValue turnShape(double u) {
  static const Eigen::Vector4d c = turnCoefficients();
  const double u2 = u * u;
  return {1 + u * (c[0] + u2 * (c[1] + u2 * (c[2] + u2 * c[3]))),
          c[0] + u2 * (3 * c[1] + u2 * (5 * c[2] + u2 * 7 * c[3])),
          u * (6 * c[1] + u2 * (20 * c[2] + u2 * 42 * c[3])),
          6 * c[1] + u2 * (60 * c[2] + u2 * 210 * c[3])};
}

}  // namespace

ShapeValue sinShape(double phase) {
  if (phase < kSinEntry)
    return sinEntry().at(phase);
  const double s = std::sin(phase), c = std::cos(phase);
  return {s, c, -s, -c};
}

ShapeValue expShape(double phase) {
  if (phase < kExpEntry)
    return expEntry().at(phase);
  if (std::abs(phase) < kTurn)
    return turnShape(phase);
  const double e = std::exp(-std::abs(phase));
  if (phase < 0)
    return {e, e, e, e};
  return {2 - e, e, -e, e};
}

BaseCurve::BaseCurve(const model::SinBase& base)
    : amplitude_(base.alpha),
      omega_(base.omega),
      phi_(base.phi),
      c_(base.c),
      shift_slope_(1),
      exponential_(false) {}

BaseCurve::BaseCurve(const model::ExpBase& base)
    : amplitude_(base.amplitude),
      omega_(base.omega),
      phi_(-base.omega * base.t_switch),
      c_(base.c),
      shift_slope_(-base.omega),
      exponential_(true) {}

double BaseCurve::begin() const {
  return ((exponential_ ? expEntry() : sinEntry()).begin() - phi_) / omega_;
}

model::BaseValue BaseCurve::at(double t) const {
  const double phase = omega_ * t + phi_;
  const ShapeValue shape = exponential_ ? expShape(phase) : sinShape(phase);
  const double speed = amplitude_ * omega_;
  return {c_ + amplitude_ * shape.s, speed * shape.s1, speed * omega_ * shape.s2};
}

BaseCurve::Derivatives BaseCurve::derivativesAt(double t) const {
  const double phase = omega_ * t + phi_, a = amplitude_, w = omega_;
  const ShapeValue shape = exponential_ ? expShape(phase) : sinShape(phase);
  const double s1 = shape.s1, s2 = shape.s2, s3 = shape.s3;
  // Of the phase by omega: with a given switching time, t - t_switch.
  const double by_omega = exponential_ ? phase / w : t;
  Derivatives d;
  d.value = {c_ + a * shape.s, a * w * s1, a * w * w * s2};
  d.dq << shape.s, a * s1 * by_omega, a * s1 * shift_slope_, 1;
  d.dqd << w * s1, a * (s1 + w * s2 * by_omega), a * w * s2 * shift_slope_, 0;
  d.dqdd << w * w * s2, a * w * (2 * s2 + w * s3 * by_omega), a * w * w * s3 * shift_slope_, 0;
  return d;
}

}  // namespace fastball::planner
