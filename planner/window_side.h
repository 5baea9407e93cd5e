#pragma once

#include "model/swing.h"
#include "planner/window_throw.h"

namespace fastball::planner {

/// Derivatives of a motion (q, qd, qdd) by the variables of a WindowThrow.
using ByThrow = Eigen::Matrix<double, 3 * model::kArmJoints, kWindowVariables>;

/// One side of a window: a ramp, then a quartic to rest, joint by joint. Before the window time runs backwards: speeds change
/// their sign, and a run-up is a braking.
class WindowSide {
 public:
  /// @param x must outlive this. @param before the window, else after it.
  WindowSide(const WindowThrow& x, bool before) : x_(x), before_(before) {}

  /// @param from motion at the window's edge. @param t [s] away from it, at least 0.
  /// @param edge derivatives of `from`, or null; then `slope` is null too.
  model::ArmMotion at(const model::ArmMotion& from,
                      double t,
                      const ByWindow* edge,
                      ByThrow* slope) const;

 private:
  struct Joint;
  static Joint ramp(const model::BaseValue& from, double far_acceleration, double t);
  Joint jointAt(const model::BaseValue& from, int j, double t) const;
  void putSlopes(const Joint& joint, const ByWindow& edge, int j, ByThrow& slope) const;

  const WindowThrow& x_;
  bool before_;
};

/// Motion at time t [s] < 0, before a window that begins with `begin`.
model::ArmMotion motionBefore(const WindowThrow& x, const model::ArmMotion& begin, double t);
/// Motion t [s] > 0 after a window that ends with `end`.
model::ArmMotion motionAfter(const WindowThrow& x, const model::ArmMotion& end, double t);

}  // namespace fastball::planner
