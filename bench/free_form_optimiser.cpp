#include "bench/free_form_optimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <tuple>

#include "bench/limit_restoration.h"

namespace fastball::bench {
namespace {

constexpr int kPlaces = 2000;  // of the grid: 0.4 ms apart in a motion of 0.8 s
/// Which limits are watched: those nearer than `near` at their peaks and at every `sparse`-th place, those
/// nearer than `nearest` at every `dense`-th.
struct Watch {
  int sparse, dense;
  double near, nearest;
};
constexpr Watch kQuick = {100, 25, 0.3, 0.05}, kThorough = {50, 10, 0.3, 0.05};
constexpr double kObjectiveScale = 0.1;
constexpr double kHolds = 1e-6;    // largest violation in a throw
constexpr double kSettled = 1e-4;  // [m/s]
constexpr int kRounds = 40, kEvaluations = 40;
// Of the box about the present point in which a round searches, in coordinates of the basis.
constexpr double kFirstRadius = 0.3, kLeastRadius = 1e-4;
// A violation that a round may leave behind however little there was before; less from round to round.
// A start that breaks something by more is restored first, at every so many-th place.
constexpr double kFar = 0.03;
constexpr int kCoarse = 20;
constexpr double kLoose = 0.03, kTightening = 0.8;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

bool FreeFormSolution::holds() const {
  return violation <= kHolds;
}

/// What NLopt asks about in one round.
struct FreeFormOptimiser::Round {
  const FreeFormProblem& problem;
  const std::vector<SplineBasis::Rows>& grid;
  std::vector<Watched> watched;
  double reserve;
  bool only_possible;

  void watchAlso(const std::vector<Watched>& more) {
    const auto key = [](const Watched& w) { return std::tie(w.place, w.row); };
    watched.insert(watched.end(), more.begin(), more.end());
    std::sort(watched.begin(), watched.end(),
              [&](const Watched& a, const Watched& b) { return key(a) < key(b); });
    watched.erase(std::unique(watched.begin(), watched.end(),
                              [&](const Watched& a, const Watched& b) { return key(a) == key(b); }),
                  watched.end());
  }

  double value(const Eigen::VectorXd& x, double* gradient) const {
    if (only_possible) {
      if (gradient != nullptr)
        std::fill_n(gradient, x.size(), 0.0);
      return 0;
    }
    const ReleaseRows release = problem.release(x);
    if (gradient != nullptr) {
      Eigen::Map<Rows>(gradient, 1, x.size()) =
          -kObjectiveScale * problem.releaseGradient(x, release.speed_slope);
    }
    return -kObjectiveScale * release.speed;
  }

  void equal(const Eigen::VectorXd& x, double* c, double* gradient) const {
    const ReleaseRows release = problem.release(x);
    const EqualRows rows = equalRows(problem.task());
    std::copy_n(release.equal.data() + rows.first, rows.count, c);
    if (gradient != nullptr) {
      Eigen::Map<Rows>(gradient, rows.count, x.size()) =
          problem.releaseGradient(x, release.equal_slope.middleRows(rows.first, rows.count));
    }
  }

  /// Those watched, then the ring's front.
  void limits(const Eigen::VectorXd& x, double* c, double* gradient) const {
    int place = -1;
    model::ArmMotion motion;
    LimitSlopes slopes;
    Eigen::VectorXd row_gradient(x.size());
    for (const auto& [at, row] : watched) {
      if (at != place) {
        place = at;
        motion = problem.motion(x, grid[at]);
        slopes = limitSlopes(problem.task(), motion);
      }
      *c++ = slopes.rows.value[row] + reserve;
      if (gradient == nullptr)
        continue;
      problem.gradient(grid[at], motion, x[problem.durationIndex()], slopes.by_q.row(row),
                       slopes.by_qd.row(row), slopes.by_qdd.row(row), row_gradient);
      gradient = std::copy_n(row_gradient.data(), x.size(), gradient);
    }
    const ReleaseRows release = problem.release(x);
    *c = release.grazing;
    if (gradient != nullptr) {
      Eigen::Map<Rows>(gradient, 1, x.size()) = problem.releaseGradient(x, release.grazing_slope);
    }
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& start, double radius);
};

Eigen::VectorXd FreeFormOptimiser::Round::solve(const Eigen::VectorXd& start, double radius) {
  const auto n = static_cast<unsigned>(start.size());
  nlopt::opt optimiser(nlopt::LD_SLSQP, n);
  const Eigen::VectorXd low = problem.lower().cwiseMax((start.array() - radius).matrix());
  const Eigen::VectorXd high = problem.upper().cwiseMin((start.array() + radius).matrix());
  optimiser.set_lower_bounds({low.data(), low.data() + n});
  optimiser.set_upper_bounds({high.data(), high.data() + n});
  optimiser.set_min_objective(
      [](unsigned size, const double* x, double* gradient, void* data) {
        return static_cast<const Round*>(data)->value(Eigen::Map<const Eigen::VectorXd>(x, size),
                                                      gradient);
      },
      this);
  optimiser.add_inequality_mconstraint(
      [](unsigned, double* c, unsigned size, const double* x, double* gradient, void* data) {
        static_cast<const Round*>(data)->limits(Eigen::Map<const Eigen::VectorXd>(x, size), c,
                                                gradient);
      },
      this, std::vector<double>(watched.size() + 1, 1e-8));
  if (const int count = equalRows(problem.task()).count; count > 0) {
    optimiser.add_equality_mconstraint(
        [](unsigned, double* c, unsigned size, const double* x, double* gradient, void* data) {
          static_cast<const Round*>(data)->equal(Eigen::Map<const Eigen::VectorXd>(x, size), c,
                                                 gradient);
        },
        this, std::vector<double>(count, 1e-9));
  }
  optimiser.set_maxeval(kEvaluations);
  optimiser.set_ftol_abs(1e-8);
  std::vector<double> x(start.data(), start.data() + n);
  double best = 0;
  try {
    optimiser.optimize(x, best);
  } catch (const std::runtime_error&) {
    // `x` is the best so far; the caller looks at what it violates.
  }
  return Eigen::Map<const Eigen::VectorXd>(x.data(), n);
}

FreeFormOptimiser::FreeFormOptimiser(const FreeFormProblem& problem) : problem_(problem) {
  grid_.reserve(kPlaces + 3);
  for (int i = 0; i <= kPlaces; ++i)
    grid_.push_back(problem.basis().at(static_cast<double>(i) / kPlaces));
  for (int i = 0; i <= kPlaces; i += kCoarse)
    coarse_.push_back(grid_[i]);
  // At rest before and after the motion the arm holds its own weight.
  for (const int end : {0, kPlaces}) {
    grid_.push_back(grid_[end]);
    grid_.back().bottomRows<2>().setZero();
  }
}

Eigen::MatrixXd FreeFormOptimiser::limitsOnGrid(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd values(LimitRows::kCount, grid_.size());
  for (std::size_t i = 0; i < grid_.size(); ++i)
    values.col(i) = limitRows(problem_.task(), problem_.motion(x, grid_[i])).value;
  return values;
}

std::vector<FreeFormOptimiser::Watched> FreeFormOptimiser::near(const Eigen::VectorXd& x,
                                                                bool thorough) const {
  const Watch& watch = thorough ? kThorough : kQuick;
  const Eigen::MatrixXd values = limitsOnGrid(x);
  std::vector<Watched> watched;
  for (int i = 0; i < values.cols(); ++i) {
    for (int row = 0; row < LimitRows::kCount; ++row) {
      const double value = values(row, i);
      const bool rises = i == 0 || value >= values(row, i - 1);
      const bool falls = i >= kPlaces || value > values(row, i + 1);
      const bool peak = (rises && falls) || i > kPlaces;
      const bool look = peak || i % watch.sparse == 0;
      if ((look && value > -watch.near) || (i % watch.dense == 0 && value > -watch.nearest))
        watched.push_back({i, row});
    }
  }
  return watched;
}

FreeFormSolution FreeFormOptimiser::assess(const Eigen::VectorXd& x, double reserve) const {
  FreeFormSolution solution{x, 0, std::numeric_limits<double>::infinity()};
  if (!x.allFinite())
    return solution;
  const Eigen::MatrixXd limits = limitsOnGrid(x);
  const ReleaseRows release = problem_.release(x);
  if (!limits.allFinite() || !release.equal.allFinite())
    return solution;
  const EqualRows rows = equalRows(problem_.task());
  solution.speed = release.speed;
  solution.violation = std::max({0.0, limits.maxCoeff() + reserve / 2, release.grazing});
  for (int i = rows.first; i < rows.first + rows.count; ++i)
    solution.violation = std::max(solution.violation, std::abs(release.equal[i]));
  return solution;
}

FreeFormSolution FreeFormOptimiser::optimise(const Eigen::VectorXd& start,
                                             Aim aim,
                                             double reserve) const {
  const bool only_possible = aim == Aim::kPossible;
  FreeFormSolution present = assess(start, reserve);
  if (present.violation > kFar)
    present = assess(restored(problem_, coarse_, start), reserve);
  FreeFormSolution best = present;
  std::vector<Watched> also;
  double radius = kFirstRadius, loose = kLoose;
  for (int i = 0; i < kRounds && radius > kLeastRadius; ++i, loose *= kTightening) {
    if (!std::isfinite(present.violation) || (only_possible && present.holds()))
      break;
    Round round{problem_, grid_, near(present.x, aim == Aim::kFastestOfAll), reserve,
                only_possible};
    round.watchAlso(also);
    const FreeFormSolution next = assess(round.solve(present.x, radius), reserve);
    if (present.holds() && next.holds() && next.speed - present.speed < kSettled)
      break;
    const bool better = next.holds() ? !present.holds() || next.speed > present.speed
                                     : next.violation < std::max(0.9 * present.violation, loose);
    const double step = next.x.allFinite() ? (next.x - present.x).cwiseAbs().maxCoeff() : radius;
    if (!better) {
      radius = std::min(radius, step) / 4;
      if (std::isfinite(next.violation))
        also = near(next.x, aim == Aim::kFastestOfAll);
      continue;
    }
    present = next;
    if (present.holds())
      also.clear();
    if (present.holds() ? !best.holds() || present.speed > best.speed : !best.holds())
      best = present;
    if (step > 0.9 * radius)
      radius *= 2;
  }
  return best;
}

Eigen::VectorXd swingThrough(const FreeFormProblem& problem,
                             const BestRelease& release,
                             double duration) {
  constexpr int kPieces = 60;
  constexpr double kRelease = 0.6, kReach = 0.25;  // of the duration
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(kPieces + 1, 0, 1);
  // Its slope is (1 - z^2)^2 between rest and rest, z = -1..1.
  const auto swing = [&](double place) {
    const double z = std::clamp((place - kRelease) / kReach, -1.0, 1.0);
    return kReach * (z - 2 * std::pow(z, 3) / 3 + std::pow(z, 5) / 5);
  };
  const Eigen::VectorXd shape = problem.basis().fit(s, s.unaryExpr(swing));
  const Eigen::VectorXd still = problem.basis().fit(s, Eigen::VectorXd::Ones(s.size()));
  Eigen::VectorXd x(problem.size());
  for (int j = 0; j < model::kArmJoints; ++j) {
    if (problem.count(j) == 1) {
      x[problem.first(j)] = release.q[j];
    } else {
      x.segment(problem.first(j), problem.count(j)) =
          release.q[j] * still + release.qd[j] * duration * shape;
    }
  }
  x.tail<3>() << duration, kRelease, release.flight_time;
  return x;
}

}  // namespace fastball::bench
