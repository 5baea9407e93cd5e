#include "planner/window_throw.h"

#include <Eigen/Cholesky>

#include "planner/window_cost.h"

namespace fastball::planner {
namespace {

// Marquardt's damping of the scaled variables.
constexpr double kFirstDamping = 1, kLargestDamping = 1e8;
constexpr double kCorrectionDamping = 0.05;  // a step or two shall do
constexpr double kTolerance = 2e-3;          // of a limit, by which a solution may exceed its share
constexpr double kSettled = 1e-4;            // of the cost: a smaller gain is no progress
constexpr int kSmallGains = 4;               // in a row, after which it is enough

WindowSolution solutionAt(const WindowVector& x, WindowCost& cost, double length) {
  WindowSolution solution;
  solution.x = fromVector(x, length);
  solution.cost = cost.at(x, false).value;
  solution.violation = cost.violation();
  solution.feasible = solution.violation <= kTolerance;
  solution.residual = cost.motion().residual;
  return solution;
}

}  // namespace

WindowVector toVector(const WindowThrow& x) {
  WindowVector v;
  v << x.window.q_start, x.window.time_to_go, x.window.joint3, x.window.pace, x.run_up, x.brake,
      x.qdd_before, x.qdd_after;
  return v;
}

WindowThrow fromVector(const WindowVector& v, double length) {
  WindowThrow x;
  x.window.q_start = v.head<4>();
  x.window.time_to_go = v[kTimeToGo];
  x.window.joint3 = v.segment<3>(5);
  x.window.pace = v.segment<2>(kPace);
  x.window.length = length;
  x.run_up = v.segment<4>(10);
  x.brake = v.segment<4>(14);
  x.qdd_before = v.segment<4>(18);
  x.qdd_after = v.segment<4>(22);
  return x;
}

WindowSolution assessWindowThrow(const WindowProblem& problem, const WindowThrow& x) {
  WindowCost cost(problem);
  return solutionAt(toVector(x), cost, problem.length);
}

namespace {

WindowSolution minimise(const WindowProblem& problem,
                        const WindowThrow& start,
                        int max_evaluations,
                        bool until_feasible) {
  WindowCost cost(problem);
  WindowVector x = toVector(start);
  if (problem.free_flight)
    x.segment<2>(kPace).setZero();
  WindowCost::Sum sum = cost.at(x, true);
  bool feasible = cost.violation() <= kTolerance;
  double damping = until_feasible ? kCorrectionDamping : kFirstDamping;
  int small_gains = 0;
  while (cost.evaluations() < max_evaluations && damping < kLargestDamping) {
    if (until_feasible && feasible)
      break;
    auto damped = sum.half_hessian;
    damped.diagonal().array() += damping;
    const auto hessian = sum.half_hessian.selfadjointView<Eigen::Lower>();
    const WindowVector step =
        -damped.selfadjointView<Eigen::Lower>().ldlt().solve(sum.half_gradient);
    const double promised = -step.dot(2 * sum.half_gradient + hessian * step);
    const WindowVector next = x + step.cwiseProduct(sum.scale);
    const double gain = sum.value - cost.at(next, false).value;
    if (!(gain > 0)) {
      damping *= 5;
      continue;
    }
    x = next;
    feasible = cost.violation() <= kTolerance;
    if (until_feasible && feasible)
      break;
    sum = cost.at(x, true);
    damping *= gain > 0.7 * promised ? 0.2 : gain > 0.25 * promised ? 0.7 : 2;
    small_gains = gain < kSettled * sum.value ? small_gains + 1 : 0;
    if (small_gains == kSmallGains)
      break;
  }
  return solutionAt(x, cost, problem.length);
}

}  // namespace

WindowSolution solveWindowThrow(const WindowProblem& problem,
                                const WindowThrow& start,
                                int max_evaluations) {
  return minimise(problem, start, max_evaluations, false);
}

WindowSolution correctWindowThrow(const WindowProblem& problem,
                                  const WindowThrow& start,
                                  int max_evaluations) {
  return minimise(problem, start, max_evaluations, true);
}

}  // namespace fastball::planner
