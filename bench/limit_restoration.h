#pragma once

#include <Eigen/Core>
#include <vector>

#include "bench/free_form_problem.h"

namespace fastball::bench {

/// A throw near x that breaks limits and misses the target less: least squares of what is broken at the places of
/// the basis given, and of the miss, by Levenberg and Marquardt's method. Where constraints contradict each
/// other to first order, as far from any throw they do, this still makes way.
Eigen::VectorXd restored(const FreeFormProblem& problem,
                         const std::vector<SplineBasis::Rows>& places,
                         const Eigen::VectorXd& x);

}  // namespace fastball::bench
