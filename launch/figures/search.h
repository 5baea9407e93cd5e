#pragma once

#include <Eigen/Core>
#include <functional>

namespace fastball::launch {

/// What is wanted of variables x between bounds: the largest `worth` with all `inequalities` <= 0.
struct SearchProblem {
  struct Values {
    double worth = 0;
    Eigen::VectorXd inequalities;  ///< of the same size for every x
  };
  Eigen::VectorXd lower, upper;
  std::function<Values(const Eigen::VectorXd&)> evaluate;
};

struct SearchResult {
  Eigen::VectorXd x;
  double worth = 0;
  double violation = 0;  ///< largest inequality, 0: all hold
};

/// NLopt's SLSQP from `start`, with gradients from forward differences; `evaluations` at most, of
/// worth and gradient.
SearchResult searchFrom(const SearchProblem& problem,
                        const Eigen::VectorXd& start,
                        int evaluations);

}  // namespace fastball::launch
