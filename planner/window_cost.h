#pragma once

#include "planner/held_ball.h"
#include "planner/swing_limits.h"
#include "planner/window_side.h"
#include "planner/window_throw.h"

namespace fastball::planner {

/// Bounds of the variables of a WindowThrow, and their typical sizes.
struct WindowBounds {
  WindowVector low, high, scale;
};
const WindowBounds& windowBounds();

/// What a window throw costs: a sum of squares of weighted rows. A row stands for a limit that is exceeded (at one time of the
/// motion), for what an error does to the landing, or for the push of the hand in the window. Most limits are kept, and cost
/// nothing.
class WindowCost {
 public:
  using Slope = Eigen::Matrix<double, 1, kWindowVariables>;
  /// The sum with its gradient and Gauss's approximation of half its Hessian (lower triangle), by x / scale.
  struct Sum {
    bool with_slopes = false;
    WindowVector scale = WindowVector::Ones();  ///< of the variables; 0: one that is held
    double value = 0;
    WindowVector half_gradient = WindowVector::Zero();
    Eigen::Matrix<double, kWindowVariables, kWindowVariables> half_hessian =
        Eigen::Matrix<double, kWindowVariables, kWindowVariables>::Zero();
    void add(double row, const Slope& slope);
  };

  /// @param problem must outlive this.
  explicit WindowCost(const WindowProblem& problem);

  /// @param with_slopes else the sum has its value alone.
  Sum at(const WindowVector& x, bool with_slopes);
  /// Of the last x: how much it exceeds a limit at most, as a share of it (negative: room to all).
  double violation() const { return violation_; }
  /// Of the last x; without samples if the arm cannot follow.
  const WindowMotion& motion() const { return motion_; }
  int evaluations() const { return evaluations_; }

 private:
  void addBounds(const WindowVector& x, Sum& sum);
  void addLimits(const WindowThrow& x, Sum& sum);
  void addSide(const WindowSide& side, bool before, Sum& sum);
  void addSample(const model::ArmMotion& sample, const ByThrow& slopes, Sum& sum);
  void addArrival(Sum& sum);
  void addErrors(const WindowThrow& x, Sum& sum);
  void addPush(const WindowThrow& x, Sum& sum);
  void addSlowness(Sum& sum);
  void addNearness(const WindowVector& x, Sum& sum);

  const WindowProblem& problem_;
  SwingTask limit_task_;  ///< must outlive limits_
  SwingLimits limits_;
  HeldBall held_;
  WindowMotion motion_;
  WindowSlopes slopes_;
  double violation_ = 0;
  int evaluations_ = 0;
};

}  // namespace fastball::planner
