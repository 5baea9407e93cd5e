#include "planner/base_curve.h"

#include "planner/polynomial.h"

namespace fastball::planner {
namespace {

constexpr double kSinEntry =
    0.35;  // [rad] of phase after t_s: the speed there is a third of its peak
constexpr double kExpEntry = 2.0;  // e-folds before the switch: the speed there is 14 % of its peak
constexpr double kTurn = 0.012;    // [s]: half the time in which the acceleration changes its sign

}  // namespace

RestEntry::RestEntry(const model::BaseValue& value, double t)
    : begin_(t), end_(t), q_rest_(value.q) {
  // A base function without amplitude rests anyway.
  if (value.qdd == 0)
    return;
  const double duration = 2 * value.qd / value.qdd;
  begin_ = t - duration;
  jerk_ = value.qdd / duration;
  q_rest_ = value.q - value.qdd * duration * duration / 6;
}

model::BaseValue RestEntry::at(double t) const {
  const double s = t > begin_ ? t - begin_ : 0;
  return {q_rest_ + jerk_ * s * s * s / 6, jerk_ * s * s / 2, jerk_ * s};
}

SinCurve::SinCurve(const model::SinBase& base) : base_(base) {
  const double t = base.start() + kSinEntry / base.omega;
  entry_ = RestEntry(base.at(t), t);
}

model::BaseValue SinCurve::at(double t) const {
  return t < entry_.end() ? entry_.at(t) : base_.at(t);
}

ExpCurve::ExpCurve(const model::ExpBase& base) : base_(base) {
  const double t = base.t_switch - kExpEntry / base.omega;
  entry_ = RestEntry(base.at(t), t);
  turn_begin_ = base.at(base.t_switch - kTurn);
  turn_end_ = base.at(base.t_switch + kTurn);
}

model::BaseValue ExpCurve::at(double t) const {
  if (t < entry_.end())
    return entry_.at(t);
  const double since = t - (base_.t_switch - kTurn);
  if (since > 0 && since < 2 * kTurn)
    return quinticAt(turn_begin_, turn_end_, 2 * kTurn, since);
  return base_.at(t);
}

}  // namespace fastball::planner
