#pragma once

#include <cmath>

namespace fastball::model {

/// A quantity that moves, with its first and second derivative in time. The operations below carry the derivatives
/// along (truncated Taylor series).
struct BaseValue {
  double q = 0, qd = 0, qdd = 0;
};

inline BaseValue operator+(const BaseValue& a, const BaseValue& b) {
  return {a.q + b.q, a.qd + b.qd, a.qdd + b.qdd};
}
inline BaseValue operator-(const BaseValue& a, const BaseValue& b) {
  return {a.q - b.q, a.qd - b.qd, a.qdd - b.qdd};
}
inline BaseValue operator*(const BaseValue& a, const BaseValue& b) {
  return {a.q * b.q, a.qd * b.q + a.q * b.qd, a.qdd * b.q + 2 * a.qd * b.qd + a.q * b.qdd};
}
inline BaseValue operator*(double a, const BaseValue& b) {
  return {a * b.q, a * b.qd, a * b.qdd};
}
/// f(a) for f with value and derivatives f0, f1, f2 at a.q.
inline BaseValue chained(const BaseValue& a, double f0, double f1, double f2) {
  return {f0, f1 * a.qd, f1 * a.qdd + f2 * a.qd * a.qd};
}
/// Of a.q not 0.
inline BaseValue inverse(const BaseValue& a) {
  const double i = 1 / a.q;
  return chained(a, i, -i * i, 2 * i * i * i);
}
/// Of a.q > 0.
inline BaseValue sqrt(const BaseValue& a) {
  const double root = std::sqrt(a.q);
  return chained(a, root, 0.5 / root, -0.25 / (a.q * root));
}

struct SinCos {
  BaseValue sin, cos;
};
inline SinCos sinCos(const BaseValue& a) {
  const double s = std::sin(a.q), c = std::cos(a.q);
  return {chained(a, s, c, -s), chained(a, c, -s, -c)};
}

}  // namespace fastball::model
