#include "bench/limit_restoration.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace fastball::bench {
namespace {

constexpr double kRoom = 0.01;  // of each limit, kept
constexpr int kSteps = 200;
constexpr double kFirstDamping = 1e-2, kLargestDamping = 1e6;
constexpr double kEnough = 1e-6;   // sum of squares
constexpr double kStalled = 1e-4;  // of the sum, in a step

/// r'r / 2 of residuals r with its gradient J'r and J'J.
struct Squares {
  double value = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd normal;

  void add(double residual, const Eigen::VectorXd& slope) {
    value += 0.5 * residual * residual;
    gradient += residual * slope;
    normal.selfadjointView<Eigen::Lower>().rankUpdate(slope);
  }
};

Squares squaresAt(const FreeFormProblem& problem,
                  const std::vector<SplineBasis::Rows>& places,
                  const Eigen::VectorXd& x) {
  const int n = problem.size();
  Squares squares{0, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  Eigen::VectorXd slope(n);
  for (const SplineBasis::Rows& at : places) {
    const model::ArmMotion motion = problem.motion(x, at);
    const LimitSlopes slopes = limitSlopes(problem.task(), motion);
    for (int row = 0; row < LimitRows::kCount; ++row) {
      const double broken = slopes.rows.value[row] + kRoom;
      if (!(broken > 0))
        continue;
      problem.gradient(at, motion, x[problem.durationIndex()], slopes.by_q.row(row),
                       slopes.by_qd.row(row), slopes.by_qdd.row(row), slope);
      squares.add(broken, slope);
    }
  }
  const ReleaseRows release = problem.release(x);
  const EqualRows rows = equalRows(problem.task());
  const Eigen::MatrixXd equal_slopes =
      problem.releaseGradient(x, release.equal_slope.middleRows(rows.first, rows.count));
  for (int i = 0; i < rows.count; ++i)
    squares.add(release.equal[rows.first + i], equal_slopes.row(i).transpose());
  if (release.grazing > 0) {
    squares.add(release.grazing,
                problem.releaseGradient(x, release.grazing_slope).row(0).transpose());
  }
  return squares;
}

}  // namespace

Eigen::VectorXd restored(const FreeFormProblem& problem,
                         const std::vector<SplineBasis::Rows>& places,
                         const Eigen::VectorXd& x) {
  const Eigen::VectorXd low = problem.lower(), high = problem.upper();
  Eigen::VectorXd present = x;
  Squares squares = squaresAt(problem, places, present);
  double damping = kFirstDamping;
  for (int i = 0; i < kSteps && squares.value > kEnough && damping < kLargestDamping; ++i) {
    Eigen::MatrixXd normal = squares.normal;
    normal.diagonal().array() += damping;
    const Eigen::VectorXd step =
        normal.selfadjointView<Eigen::Lower>().llt().solve(squares.gradient);
    const Eigen::VectorXd next = (present - step).cwiseMax(low).cwiseMin(high);
    Squares there = squaresAt(problem, places, next);
    if (!(there.value < squares.value)) {
      damping *= 4;
      continue;
    }
    const bool stalled = there.value > (1 - kStalled) * squares.value;
    present = next;
    squares = std::move(there);
    damping /= 3;
    if (stalled)
      break;
  }
  return present;
}

}  // namespace fastball::bench
