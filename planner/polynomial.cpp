#include "planner/polynomial.h"

#include <algorithm>

namespace fastball::planner {

model::BaseValue quinticAt(const model::BaseValue& a,
                           const model::BaseValue& b,
                           double T,
                           double t) {
  const double u = t / T;
  // Coefficients in u of q, from the six end conditions.
  const double v0 = a.qd * T, v1 = b.qd * T, a0 = a.qdd * T * T, a1 = b.qdd * T * T;
  const double d = b.q - a.q;
  const double c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
  const double c5 = 6 * d - 3 * (v0 + v1) - 0.5 * (a0 - a1);
  model::BaseValue value;
  value.q = a.q + u * (v0 + u * (0.5 * a0 + u * (c3 + u * (c4 + u * c5))));
  value.qd = (v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / T;
  value.qdd = (a0 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (T * T);
  return value;
}

model::BaseValue brakeAt(const model::BaseValue& from, double T, double t) {
  const double u = std::clamp(t / T, 0.0, 1.0);
  // Speed v0 (1 - 3u^2 + 2u^3) + a0 T (u - 2u^2 + u^3): it and its derivative are 0 at u = 1.
  const double v0 = from.qd, a0 = from.qdd * T;
  model::BaseValue value;
  value.q =
      from.q +
      T * u * (v0 * (1 + u * u * (-1 + 0.5 * u)) + a0 * u * (0.5 + u * (-2.0 / 3.0 + 0.25 * u)));
  value.qd = v0 * (1 + u * u * (-3 + 2 * u)) + a0 * u * (1 + u * (-2 + u));
  value.qdd = (v0 * u * (-6 + 6 * u) + a0 * (1 + u * (-4 + 3 * u))) / T;
  return value;
}

}  // namespace fastball::planner
