#pragma once

#include <Eigen/Core>

#include "model/swing.h"

/// The base functions of Eq. (12) with their corners rounded. As printed, the sin joints jump from rest to full acceleration, the
/// exp joint never rests, and its acceleration jumps where omega changes sign. Each of these curves is one fixed shape of its
/// phase, alpha S(omega t + phi) + c, three times continuously differentiable everywhere: the arm can follow it, and its torques
/// have no kinks, so that their peaks move smoothly with the parameters.
namespace fastball::planner {

/// A shape at one phase with its first three derivatives by the phase.
struct ShapeValue {
  double s = 0, s1 = 0, s2 = 0, s3 = 0;
};

/// sin, entered from rest after its t_s; its t_e is not looked at.
ShapeValue sinShape(double phase);
/// e^phase, entered from rest, and 2 - e^-phase after phase 0: there omega changes its sign. The
/// change is spread over some phase.
ShapeValue expShape(double phase);

/// One base function in time.
class BaseCurve {
 public:
  /// alpha S(omega t + phi) + c.
  explicit BaseCurve(const model::SinBase& base);
  /// amplitude S(omega (t - t_switch)) + c.
  explicit BaseCurve(const model::ExpBase& base);
  /// [s], at rest before.
  double begin() const;
  /// At t [s].
  model::BaseValue at(double t) const;

  /// Derivatives by the four parameters in the order of SinBase and ExpBase: amplitude, omega, phase or switching time, c.
  struct Derivatives {
    model::BaseValue value;
    Eigen::Vector4d dq, dqd, dqdd;
  };
  Derivatives derivativesAt(double t) const;

 private:
  double amplitude_, omega_, phi_, c_;
  double shift_slope_;  ///< derivative of the phase by the third parameter
  bool exponential_;
};

}  // namespace fastball::planner
