#include "launch/figures/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <vector>

namespace fastball::launch {
namespace {

constexpr double kStep = 1e-7;       // of the differences, relative to the span of the variable
constexpr double kTolerance = 1e-7;  // of the inequalities

/// Values and derivatives at the last point: NLopt asks for the worth and for the inequalities one
/// after the other. The optimiser works with u in 0..1 between the bounds.
class Search {
 public:
  explicit Search(const SearchProblem& problem)
      : problem_(problem), span_(problem.upper - problem.lower) {}

  Eigen::VectorXd x(const Eigen::VectorXd& u) const {
    return problem_.lower + span_.cwiseProduct(u);
  }
  Eigen::VectorXd u(const Eigen::VectorXd& x) const {
    return (x - problem_.lower).cwiseQuotient(span_).cwiseMax(0).cwiseMin(1);
  }

  void look(const double* point, bool with_gradient) {
    const Eigen::Index n = span_.size();
    const Eigen::Map<const Eigen::VectorXd> u(point, n);
    if (u_.size() != n || u_ != u) {
      u_ = u;
      values_ = problem_.evaluate(x(u_));
      has_gradient_ = false;
    }
    if (!with_gradient || has_gradient_)
      return;
    has_gradient_ = true;
    worth_gradient_.resize(n);
    gradient_.resize(values_.inequalities.size(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      // Inwards, so that no variable leaves its bounds.
      const double step = u_[i] > 0.5 ? -kStep : kStep;
      Eigen::VectorXd shifted = u_;
      shifted[i] += step;
      const SearchProblem::Values moved = problem_.evaluate(x(shifted));
      worth_gradient_[i] = (moved.worth - values_.worth) / step;
      gradient_.col(i) = (moved.inequalities - values_.inequalities) / step;
    }
  }

  static double minusWorth(unsigned n, const double* u, double* gradient, void* data) {
    Search& search = *static_cast<Search*>(data);
    search.look(u, gradient != nullptr);
    if (gradient != nullptr)
      Eigen::Map<Eigen::VectorXd>(gradient, n) = -search.worth_gradient_;
    return -search.values_.worth;
  }
  static void inequalities(unsigned m,
                           double* c,
                           unsigned n,
                           const double* u,
                           double* gradient,
                           void* data) {
    Search& search = *static_cast<Search*>(data);
    search.look(u, gradient != nullptr);
    Eigen::Map<Eigen::VectorXd>(c, m) = search.values_.inequalities;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (gradient != nullptr)
      Eigen::Map<RowMajor>(gradient, m, n) = search.gradient_;
  }

 private:
  const SearchProblem& problem_;
  Eigen::VectorXd span_;
  Eigen::VectorXd u_;
  SearchProblem::Values values_;
  bool has_gradient_ = false;
  Eigen::VectorXd worth_gradient_;
  Eigen::MatrixXd gradient_;
};

}  // namespace

SearchResult searchFrom(const SearchProblem& problem,
                        const Eigen::VectorXd& start,
                        int evaluations) {
  Search search(problem);
  const unsigned n = static_cast<unsigned>(start.size());
  const std::size_t m = static_cast<std::size_t>(problem.evaluate(start).inequalities.size());
  nlopt::opt optimiser(nlopt::LD_SLSQP, n);
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_min_objective(Search::minusWorth, &search);
  optimiser.add_inequality_mconstraint(Search::inequalities, &search,
                                       std::vector<double>(m, kTolerance));
  optimiser.set_maxeval(evaluations);
  optimiser.set_ftol_rel(1e-7);
  const Eigen::VectorXd u = search.u(start);
  std::vector<double> point(u.data(), u.data() + u.size());
  double value = 0;
  try {
    optimiser.optimize(point, value);
  } catch (const nlopt::roundoff_limited&) {
    // `point` is the best so far; the caller looks at its violation.
  } catch (const std::runtime_error&) {
    // Likewise: SLSQP gives up on inconsistent constraints with a generic failure.
  }
  SearchResult result;
  result.x = search.x(Eigen::Map<const Eigen::VectorXd>(point.data(), n));
  const SearchProblem::Values values = problem.evaluate(result.x);
  result.worth = values.worth;
  result.violation = values.inequalities.allFinite() && std::isfinite(values.worth)
                         ? std::max(0.0, values.inequalities.maxCoeff())
                         : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace fastball::launch
