#include <algorithm>
#include <nlopt.hpp>
#include <vector>

#include "planner/swing_problem.h"

namespace fastball::planner {
namespace {

constexpr double kStep = 1e-7;  // of the forward differences, relative to the variable's scale

/// Typical size of each variable: the optimiser works with x / scale.
const SwingVector& scales() {
  static const SwingVector scale = [] {
    SwingVector s;
    s << 0.5, 3, 0.5, 0.5, 0.5, 5, 0.02, 0.5, 0.5, 3, 0.5, 0.5, 0.5, 0.5;
    return s;
  }();
  return scale;
}

/// The problem at the last point asked about: NLopt asks for objective and constraints one after another.
class Cache {
 public:
  explicit Cache(const SwingProblem& problem) : problem_(problem) {}

  const SwingProblem::Values& values(const double* u) {
    lookAt(u);
    return values_;
  }
  void needGradient(const double* u) {
    lookAt(u);
    if (has_gradient_)
      return;
    has_gradient_ = true;
    ++evaluations_;
    const SwingVector x = u_.cwiseProduct(scales());
    for (int i = 0; i < kSwingVariables; ++i) {
      SwingVector shifted = x;
      shifted[i] += kStep * scales()[i];
      const SwingProblem::Values moved = problem_.evaluate(shifted);
      speed_gradient_[i] = (moved.release_speed - values_.release_speed) / kStep;
      inequality_gradient_.col(i) = (moved.inequalities - values_.inequalities) / kStep;
      equality_gradient_.col(i) = (moved.equalities - values_.equalities) / kStep;
    }
  }
  const SwingVector& speedGradient() const { return speed_gradient_; }
  const auto& inequalityGradient() const { return inequality_gradient_; }
  const auto& equalityGradient() const { return equality_gradient_; }
  int evaluations() const { return evaluations_; }

 private:
  void lookAt(const double* u) {
    const SwingVector point = Eigen::Map<const SwingVector>(u);
    if (known_ && point == u_)
      return;
    known_ = true;
    has_gradient_ = false;
    u_ = point;
    values_ = problem_.evaluate(u_.cwiseProduct(scales()));
  }

  const SwingProblem& problem_;
  bool known_ = false, has_gradient_ = false;
  int evaluations_ = 0;
  SwingVector u_;
  SwingProblem::Values values_;
  SwingVector speed_gradient_;
  Eigen::Matrix<double, SwingProblem::kInequalities, kSwingVariables, Eigen::RowMajor>
      inequality_gradient_;
  Eigen::Matrix<double, SwingProblem::kEqualities, kSwingVariables, Eigen::RowMajor>
      equality_gradient_;
};

/// What is minimised: minus Eq. (15) with K_r a multiple of the identity, or the distance from given parameters.
struct Objective {
  Cache* cache;
  const SwingVector* near;  ///< scaled; null: Eq. (15)
};

double objective(unsigned, const double* u, double* gradient, void* data) {
  const Objective& wanted = *static_cast<Objective*>(data);
  if (wanted.near != nullptr) {
    const SwingVector step = Eigen::Map<const SwingVector>(u) - *wanted.near;
    if (gradient != nullptr)
      std::copy_n(step.data(), step.size(), gradient);
    return 0.5 * step.squaredNorm();
  }
  const double speed = wanted.cache->values(u).release_speed;
  if (gradient != nullptr) {
    wanted.cache->needGradient(u);
    const SwingVector slope = -0.1 * speed * wanted.cache->speedGradient();
    std::copy_n(slope.data(), slope.size(), gradient);
  }
  return -0.05 * speed * speed;
}

void inequalities(unsigned, double* c, unsigned, const double* u, double* gradient, void* data) {
  Cache& cache = *static_cast<Cache*>(data);
  std::copy_n(cache.values(u).inequalities.data(), SwingProblem::kInequalities, c);
  if (gradient == nullptr)
    return;
  cache.needGradient(u);
  std::copy_n(cache.inequalityGradient().data(), cache.inequalityGradient().size(), gradient);
}

void equalities(unsigned count,
                double* c,
                unsigned,
                const double* u,
                double* gradient,
                void* data) {
  Cache& cache = *static_cast<Cache*>(data);
  std::copy_n(cache.values(u).equalities.data(), count, c);
  if (gradient == nullptr)
    return;
  cache.needGradient(u);
  std::copy_n(cache.equalityGradient().data(), count * kSwingVariables, gradient);
}

/// SLSQP on the scaled variables u, in place.
void minimise(const SwingProblem& problem, Objective& wanted, int max_evaluations, SwingVector& u) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, kSwingVariables);
  std::vector<double> low(kSwingVariables), high(kSwingVariables), point(kSwingVariables);
  for (int i = 0; i < kSwingVariables; ++i) {
    low[i] = problem.lower()[i] / scales()[i];
    high[i] = problem.upper()[i] / scales()[i];
    point[i] = std::clamp(u[i], low[i], high[i]);
  }
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_min_objective(objective, &wanted);
  optimiser.add_inequality_mconstraint(inequalities, wanted.cache,
                                       std::vector<double>(SwingProblem::kInequalities, 1e-6));
  optimiser.add_equality_mconstraint(equalities, wanted.cache,
                                     std::vector<double>(problem.equalityCount(), 1e-7));
  optimiser.set_maxeval(max_evaluations);
  optimiser.set_ftol_abs(1e-6);
  double value = 0;
  try {
    optimiser.optimize(point, value);
  } catch (const nlopt::roundoff_limited&) {
    // `point` is the best so far; the caller looks at its violation.
  } catch (const std::runtime_error&) {
    // Likewise: SLSQP gives up on inconsistent constraints with a generic failure.
  }
  u = Eigen::Map<const SwingVector>(point.data());
}

SwingSolution solve(const SwingTask& task,
                    const SwingVector& start,
                    int elbow_sign,
                    bool nearest,
                    int max_evaluations) {
  const SwingProblem problem(task, elbow_sign);
  Cache cache(problem);
  SwingVector u = start.cwiseQuotient(scales());
  const SwingVector near = u;
  Objective wanted{&cache, nearest ? &near : nullptr};
  minimise(problem, wanted, max_evaluations, u);
  SwingSolution solution;
  solution.x = u.cwiseProduct(scales());
  solution.elbow_sign = elbow_sign;
  const SwingProblem::Values values = problem.evaluate(solution.x);
  solution.release_speed = values.release_speed;
  solution.violation = values.violation();
  solution.evaluations = cache.evaluations();
  return solution;
}

}  // namespace

SwingSolution optimiseSwing(const SwingTask& task,
                            const SwingVector& start,
                            int elbow_sign,
                            int max_evaluations) {
  return solve(task, start, elbow_sign, false, max_evaluations);
}

SwingSolution correctSwing(const SwingTask& task, const SwingSolution& near, int max_evaluations) {
  return solve(task, near.x, near.elbow_sign, true, max_evaluations);
}

}  // namespace fastball::planner
