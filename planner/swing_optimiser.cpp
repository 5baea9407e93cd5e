#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <optional>
#include <vector>

#include "planner/scaled_swing.h"
#include "planner/swing_problem.h"

namespace fastball::planner {
namespace {

// Of the constraints, as SwingProblem states them.
constexpr double kTolerance = 1e-5;
// [m^2/s^2], of the objective: about 1e-5 m/s.
constexpr double kSettled = 5e-6;
// A search that has had so many looks is given up if it is slower than a known solution by more than the handicap
// [m/s], and after twice as many if it still breaks a constraint by so much.
constexpr int kFairChance = 30;
constexpr double kHandicap = 0.4, kHopeless = 0.03;
constexpr double kFlightPrice = 3;  // [1/s], in the objective
// SLSQP creeps where the constraints are much more curved than the speed. A search ends that has not won so much [m/s] in so many
// looks while it kept the constraints to within `kNearly`.
constexpr int kPatience = 25;
constexpr double kGain = 0.003, kNearly = 2e-3;
// A small violation [of the constraints] that is left is then repaired with so many evaluations.
constexpr double kRepairable = 0.05;
constexpr int kRepair = 12;
// Newton steps onto constraints that are broken by no more than so much, when that is over, and what keeps the steps finite where
// constraints say the same.
constexpr int kProjections = 4;
constexpr double kProjectable = 0.3, kProjected = 1e-4, kNormalDamping = 1e-9;

/// What is minimised: minus Eq. (15) with K_r a multiple of the identity, the time of flight, or
/// the distance from given variables.
class Objective {
 public:
  Objective(ScaledSwing& swing, SwingGoal goal, double to_beat)
      : swing_(swing), goal_(goal), to_beat_(to_beat) {}
  Objective(ScaledSwing& swing, const std::vector<double>& near) : swing_(swing), near_(&near) {}

  double value(const double* u, double* gradient) {
    const ScaledSwing::Values& values = look(u);
    const int n = static_cast<int>(swing_.size());
    Eigen::RowVectorXd slope;
    double result = 0;
    if (near_ != nullptr) {
      slope = Eigen::RowVectorXd::Map(u, n) - Eigen::RowVectorXd::Map(near_->data(), n);
      result = 0.5 * slope.squaredNorm();
    } else if (goal_ == SwingGoal::kFastest) {
      const double speed = values.release_speed;
      result = -0.05 * speed * speed;
      if (gradient != nullptr)
        slope = -0.1 * speed * swing_.gradients(u).release_speed;
    } else {
      result = kFlightPrice * values.flight_time;
      if (gradient != nullptr)
        slope = kFlightPrice * swing_.gradients(u).flight_time;
    }
    if (gradient != nullptr)
      Eigen::RowVectorXd::Map(gradient, n) = slope;
    return result;
  }

  /// The best point looked at: of those that keep the constraints the one nearest to the goal, else the one that
  /// breaks them least. A search that is ended or gives up may leave off elsewhere.
  const std::vector<double>& best() const { return best_; }
  double bestViolation() const { return best_violation_; }

 private:
  /// NLopt asks here first about every point. Ends the search where it leads nowhere.
  const ScaledSwing::Values& look(const double* u) {
    const ScaledSwing::Values& values = swing_.values(u);
    ++looks_;
    remember(u, values);
    // With what is no number SLSQP would go on for ever.
    if (!values.finite)
      throw nlopt::forced_stop();
    if (near_ == nullptr && (creeps(values) || isBeaten(values)))
      throw nlopt::forced_stop();
    return values;
  }
  void remember(const double* u, const ScaledSwing::Values& values) {
    const double violation = std::max(values.violation(), kTolerance);
    const bool better = near_ == nullptr && violation <= kTolerance && best_violation_ <= kTolerance
                            ? worth(values) > best_worth_
                            : violation < best_violation_;
    if (!better)
      return;
    best_.assign(u, u + swing_.size());
    best_violation_ = violation;
    best_worth_ = worth(values);
  }
  bool creeps(const ScaledSwing::Values& values) {
    if (values.violation() < kNearly && (!won_ || worth(values) > *won_ + kGain)) {
      won_ = worth(values);
      won_at_ = looks_;
    }
    return won_ && looks_ > won_at_ + kPatience;
  }
  bool isBeaten(const ScaledSwing::Values& values) const {
    if (to_beat_ == 0 || looks_ < kFairChance)
      return false;
    return values.release_speed < to_beat_ - kHandicap ||
           (looks_ > 2 * kFairChance && values.violation() > kHopeless);
  }

  double worth(const ScaledSwing::Values& values) const {
    return goal_ == SwingGoal::kFastest ? values.release_speed : -kFlightWorth * values.flight_time;
  }

  ScaledSwing& swing_;
  SwingGoal goal_ = SwingGoal::kFastest;
  const std::vector<double>* near_ = nullptr;  ///< null: the goal
  double to_beat_ = 0;                         ///< [m/s]; 0: none
  int looks_ = 0;
  std::vector<double> best_;
  double best_violation_ = std::numeric_limits<double>::infinity(), best_worth_ = 0;
  std::optional<double> won_;  ///< the worth when it last rose by the gain
  int won_at_ = 0;
};

double objective(unsigned, const double* u, double* gradient, void* data) {
  return static_cast<Objective*>(data)->value(u, gradient);
}

void inequalities(unsigned m,
                  double* c,
                  unsigned n,
                  const double* u,
                  double* gradient,
                  void* data) {
  ScaledSwing& swing = *static_cast<ScaledSwing*>(data);
  Eigen::Map<Eigen::VectorXd>(c, m) = swing.values(u).inequalities;
  if (gradient != nullptr)
    Eigen::Map<ScaledSwing::Matrix>(gradient, m, n) = swing.gradients(u).inequalities;
}

void equalities(unsigned m, double* c, unsigned n, const double* u, double* gradient, void* data) {
  ScaledSwing& swing = *static_cast<ScaledSwing*>(data);
  Eigen::Map<Eigen::VectorXd>(c, m) = swing.values(u).equalities;
  if (gradient != nullptr)
    Eigen::Map<ScaledSwing::Matrix>(gradient, m, n) = swing.gradients(u).equalities;
}

/// SLSQP from u, in place.
void minimise(ScaledSwing& swing, Objective& wanted, int max_evaluations, std::vector<double>& u) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, swing.size());
  const std::vector<double> low = swing.lower(), high = swing.upper();
  for (unsigned i = 0; i < swing.size(); ++i)
    u[i] = std::clamp(u[i], low[i], high[i]);
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_min_objective(objective, &wanted);
  optimiser.add_inequality_mconstraint(inequalities, &swing,
                                       std::vector<double>(swing.inequalityCount(), kTolerance));
  if (swing.equalityCount() > 0) {
    optimiser.add_equality_mconstraint(equalities, &swing,
                                       std::vector<double>(swing.equalityCount(), kTolerance));
  }
  optimiser.set_maxeval(max_evaluations);
  optimiser.set_ftol_abs(kSettled);
  double value = 0;
  try {
    optimiser.optimize(u, value);
  } catch (const std::exception&) {
    // SLSQP gives up on rounding, on inconsistent constraints and on what is no number. u is the best so far; the caller looks at
    // its violation.
  }
}

/// The shortest step to where the linearised constraints hold: onto the equalities, and onto every inequality that
/// would be exceeded without.
Eigen::VectorXd stepOnto(const ScaledSwing::Values& values, const ScaledSwing::Gradients& slopes) {
  const Eigen::Index equalities = values.equalities.size();
  std::vector<Eigen::Index> active;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(slopes.equalities.cols());
  for (;;) {
    const Eigen::VectorXd reached = values.inequalities + slopes.inequalities * step;
    const std::size_t known = active.size();
    for (Eigen::Index i = 0; i < reached.size(); ++i) {
      if (reached[i] > kTolerance / 2 && std::find(active.begin(), active.end(), i) == active.end())
        active.push_back(i);
    }
    if (active.size() == known && !step.isZero(0))
      return step;
    const auto rows = equalities + static_cast<Eigen::Index>(active.size());
    ScaledSwing::Matrix A(rows, step.size());
    Eigen::VectorXd c(rows);
    A.topRows(equalities) = slopes.equalities;
    c.head(equalities) = values.equalities;
    for (Eigen::Index k = equalities; k < rows; ++k) {
      A.row(k) = slopes.inequalities.row(active[k - equalities]);
      c[k] = values.inequalities[active[k - equalities]];
    }
    Eigen::MatrixXd normal = A * A.transpose();
    normal.diagonal().array() += kNormalDamping;
    step = -A.transpose() * normal.ldlt().solve(c);
    if (active.size() == known)
      return step;
  }
}

/// Newton's way to u that keeps the constraints, in place: quicker than repair() where they are nearly kept.
/// @return false if it does not get there; u is then as it was.
bool project(ScaledSwing& swing, std::vector<double>& u) {
  const std::vector<double> low = swing.lower(), high = swing.upper();
  std::vector<double> next = u;
  for (int i = 0;; ++i) {
    const ScaledSwing::Values values = swing.values(next.data());
    if (!values.finite || values.violation() > kProjectable)
      return false;
    if (values.violation() <= kProjected) {
      u = next;
      return true;
    }
    if (i == kProjections)
      return false;
    const Eigen::VectorXd step = stepOnto(values, swing.gradients(next.data()));
    for (std::size_t k = 0; k < next.size(); ++k)
      next[k] = std::clamp(next[k] + step[static_cast<Eigen::Index>(k)], low[k], high[k]);
  }
}

/// The nearest u that keeps the constraints, in place.
void repair(ScaledSwing& swing, int max_evaluations, std::vector<double>& u) {
  const std::vector<double> near = u;
  Objective wanted(swing, near);
  minimise(swing, wanted, max_evaluations, u);
}

/// The u nearest to the goal, in place.
void pursueGoal(ScaledSwing& swing,
                SwingGoal goal,
                int max_evaluations,
                double to_beat,
                std::vector<double>& u) {
  Objective wanted(swing, goal, to_beat);
  minimise(swing, wanted, max_evaluations, u);
  if (!wanted.best().empty() && !(swing.values(u.data()).violation() <= wanted.bestViolation()))
    u = wanted.best();
  const double violation = swing.values(u.data()).violation();
  if (violation > kTolerance && violation < kRepairable)
    repair(swing, kRepair, u);
}

SwingSolution solutionAt(const SwingProblem& problem,
                         const ScaledSwing& swing,
                         const std::vector<double>& u) {
  SwingSolution solution;
  solution.x = swing.parameters(u.data());
  solution.elbow_sign = problem.elbowSign();
  const SwingProblem::Values values = problem.evaluate(solution.x);
  solution.release_speed = values.release_speed;
  solution.violation = values.violation();
  return solution;
}

bool isFinite(const std::vector<double>& u) {
  return std::all_of(u.begin(), u.end(), [](double value) { return std::isfinite(value); });
}

SwingSolution unsolved(const SwingVector& start, int elbow_sign) {
  return {start, elbow_sign, 0, std::numeric_limits<double>::infinity()};
}

}  // namespace

SwingSolution optimiseSwing(const SwingTask& task,
                            const SwingVector& start,
                            int elbow_sign,
                            int max_evaluations,
                            double to_beat) {
  const SwingProblem problem(task, elbow_sign);
  ScaledSwing swing(problem, start);
  std::vector<double> u = swing.start();
  if (!isFinite(u))
    return unsolved(start, elbow_sign);
  pursueGoal(swing, task.goal, max_evaluations, to_beat, u);
  return solutionAt(problem, swing, u);
}

SwingSolution correctSwing(const SwingTask& task, const SwingSolution& near, int max_evaluations) {
  const SwingProblem problem(task, near.elbow_sign);
  ScaledSwing swing(problem, near.x);
  std::vector<double> u = swing.start();
  if (!isFinite(u))
    return unsolved(near.x, near.elbow_sign);
  if (!project(swing, u))
    repair(swing, max_evaluations, u);
  return solutionAt(problem, swing, u);
}

}  // namespace fastball::planner
