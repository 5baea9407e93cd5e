#include "planner/rest_quartic.h"

#include <algorithm>

namespace fastball::planner {

RestQuartic restQuartic(const model::BaseValue& from, double T, double t) {
  const double s = std::min(t / T, 1.0);
  // The cubics of Hermite for the speed, with integrals and derivatives by s: A carries the first speed, B the acceleration.
  const double A = 1 + s * s * (2 * s - 3), dA = 6 * s * (s - 1), ddA = 12 * s - 6;
  const double B = s * (1 - s) * (1 - s), dB = (1 - s) * (1 - 3 * s), ddB = 6 * s - 4;
  const double IA = s - s * s * s * (1 - s / 2), IB = s * s * (0.5 + s * (s / 4 - 2.0 / 3));
  const bool moving = t < T;
  RestQuartic r;
  r.by_speed = {T * IA, A, dA / T};
  r.by_acceleration = {T * T * IB, T * B, moving ? dB : 0};
  r.value.q = from.q + from.qd * r.by_speed.q + from.qdd * r.by_acceleration.q;
  r.value.qd = from.qd * r.by_speed.qd + from.qdd * r.by_acceleration.qd;
  r.value.qdd = from.qd * r.by_speed.qdd + from.qdd * r.by_acceleration.qdd;
  // s falls by s / T when T grows; after the end s stays 1.
  const double ds = moving ? -s / T : 0;
  r.by_duration.q = from.qd * (IA + T * A * ds) + from.qdd * (2 * T * IB + T * T * B * ds);
  r.by_duration.qd = from.qd * dA * ds + from.qdd * (B + T * dB * ds);
  r.by_duration.qdd = moving ? from.qd * (ddA * ds - dA / T) / T + from.qdd * ddB * ds : 0;
  return r;
}

}  // namespace fastball::planner
