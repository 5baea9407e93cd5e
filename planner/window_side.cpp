#include "planner/window_side.h"

#include "planner/rest_quartic.h"

namespace fastball::planner {

/// A joint's motion with its derivatives by what it begins with, in its own direction of time.
struct WindowSide::Joint {
  model::BaseValue value, by_speed, by_acceleration, by_far_acceleration, by_duration;
};

/// A ramp is linear in what it begins and ends with.
WindowSide::Joint WindowSide::ramp(const model::BaseValue& from,
                                   double far_acceleration,
                                   double t) {
  const double T = kWindowRamp;
  Joint r;
  r.by_speed = {t, 1, 0};
  r.by_far_acceleration = {t * t * t / (6 * T), t * t / (2 * T), t / T};
  r.by_acceleration = {t * t / 2 - r.by_far_acceleration.q, t - r.by_far_acceleration.qd,
                       1 - r.by_far_acceleration.qdd};
  const auto sum = [&](double model::BaseValue::*part) {
    return from.qd * r.by_speed.*part + from.qdd * r.by_acceleration.*part +
           far_acceleration * r.by_far_acceleration.*part;
  };
  r.value = {from.q + sum(&model::BaseValue::q), sum(&model::BaseValue::qd),
             sum(&model::BaseValue::qdd)};
  return r;
}

WindowSide::Joint WindowSide::jointAt(const model::BaseValue& from, int j, double t) const {
  const double far_acceleration = before_ ? x_.qdd_before[j] : x_.qdd_after[j];
  if (t <= kWindowRamp)
    return ramp(from, far_acceleration, t);
  Joint r = ramp(from, far_acceleration, kWindowRamp);
  const RestQuartic rest =
      restQuartic(r.value, before_ ? x_.run_up[j] : x_.brake[j], t - kWindowRamp);
  const auto chained = [&](const model::BaseValue& by) -> model::BaseValue {
    return {by.q + by.qd * rest.by_speed.q + by.qdd * rest.by_acceleration.q,
            by.qd * rest.by_speed.qd + by.qdd * rest.by_acceleration.qd,
            by.qd * rest.by_speed.qdd + by.qdd * rest.by_acceleration.qdd};
  };
  return {rest.value, chained(r.by_speed), chained(r.by_acceleration),
          chained(r.by_far_acceleration), rest.by_duration};
}

void WindowSide::putSlopes(const Joint& joint, const ByWindow& edge, int j, ByThrow& slope) const {
  const double s = before_ ? -1 : 1;
  const auto q = edge.row(j), qd = edge.row(4 + j), qdd = edge.row(8 + j);
  const auto put = [&](int row, double sign, double by_q, double by_speed, double by_acceleration,
                       double by_far, double by_duration) {
    slope.row(row).head<kWindowParameters>() =
        sign * (by_q * q + s * by_speed * qd + by_acceleration * qdd);
    slope(row, kWindowParameters + (before_ ? 0 : 4) + j) = sign * by_duration;
    slope(row, kWindowParameters + (before_ ? 8 : 12) + j) = sign * by_far;
  };
  put(j, 1, 1, joint.by_speed.q, joint.by_acceleration.q, joint.by_far_acceleration.q,
      joint.by_duration.q);
  put(4 + j, s, 0, joint.by_speed.qd, joint.by_acceleration.qd, joint.by_far_acceleration.qd,
      joint.by_duration.qd);
  put(8 + j, 1, 0, joint.by_speed.qdd, joint.by_acceleration.qdd, joint.by_far_acceleration.qdd,
      joint.by_duration.qdd);
}

model::ArmMotion WindowSide::at(const model::ArmMotion& from,
                                double t,
                                const ByWindow* edge,
                                ByThrow* slope) const {
  const double s = before_ ? -1 : 1;
  model::ArmMotion motion;
  if (slope != nullptr)
    slope->setZero();
  for (int j = 0; j < model::kArmJoints; ++j) {
    const Joint joint = jointAt({from.q[j], s * from.qd[j], from.qdd[j]}, j, t);
    motion.q[j] = joint.value.q;
    motion.qd[j] = s * joint.value.qd;
    motion.qdd[j] = joint.value.qdd;
    if (slope != nullptr)
      putSlopes(joint, *edge, j, *slope);
  }
  return motion;
}

model::ArmMotion motionBefore(const WindowThrow& x, const model::ArmMotion& begin, double t) {
  return WindowSide(x, true).at(begin, -t, nullptr, nullptr);
}

model::ArmMotion motionAfter(const WindowThrow& x, const model::ArmMotion& end, double t) {
  return WindowSide(x, false).at(end, t, nullptr, nullptr);
}

}  // namespace fastball::planner
