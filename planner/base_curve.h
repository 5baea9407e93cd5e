#pragma once

#include "model/swing.h"

/// The base functions of Eq. (12) with their corners rounded. As printed, the sin joints jump from rest to full acceleration, the
/// exp joint never rests, and its acceleration jumps where omega changes sign. These curves are twice continuously
/// differentiable everywhere, so that the arm can follow them and its torque does not jump.
namespace fastball::planner {

/// Rest until `begin`, then constant jerk until `end`, where a given motion is met with its speed and acceleration. That
/// takes the time 2 qd / qdd; the angle of rest follows.
class RestEntry {
 public:
  RestEntry() = default;
  /// Meets `value` at time t [s].
  RestEntry(const model::BaseValue& value, double t);
  double begin() const { return begin_; }
  double end() const { return end_; }
  /// Before end().
  model::BaseValue at(double t) const;

 private:
  double begin_ = 0, end_ = 0;
  double q_rest_ = 0;  ///< [rad]
  double jerk_ = 0;    ///< [rad/s^3]
};

/// A sin base function, entered from rest.
class SinCurve {
 public:
  explicit SinCurve(const model::SinBase& base);
  /// [s], at rest before.
  double begin() const { return entry_.begin(); }
  model::BaseValue at(double t) const;

 private:
  model::SinBase base_;
  RestEntry entry_;
};

/// An exp base function, entered from rest, its change of sign spread over a few milliseconds about t_switch.
class ExpCurve {
 public:
  explicit ExpCurve(const model::ExpBase& base);
  /// [s], at rest before.
  double begin() const { return entry_.begin(); }
  model::BaseValue at(double t) const;

 private:
  model::ExpBase base_;
  RestEntry entry_;
  model::BaseValue turn_begin_, turn_end_;
};

}  // namespace fastball::planner
