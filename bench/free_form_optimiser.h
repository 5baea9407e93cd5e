#pragma once

#include <Eigen/Core>
#include <vector>

#include "bench/best_release.h"
#include "bench/free_form_problem.h"

namespace fastball::bench {

/// Where a free-form throw has come to.
struct FreeFormSolution {
  Eigen::VectorXd x;
  double speed = 0;  ///< [m/s], of the ball at the release
  /// Of limits and release, as LimitRows and ReleaseRows state them, on the optimiser's grid. Half of the
  /// reserve counts as violated.
  double violation = 0;
  bool holds() const;
};

/// What an optimisation is for.
enum class Aim {
  kPossible,  ///< the first throw that keeps all limits
  kFast,
  kFastestOfAll,  ///< three times slower than kFast, for its last per cent
};

/// Makes throws of one problem possible, and fast, by NLopt's SLSQP. The limits hold at every moment, which are
/// infinitely many constraints: the optimiser is given the moments where a limit is near, looks again
/// where they are now, and so on until none turns up that is broken.
class FreeFormOptimiser {
 public:
  explicit FreeFormOptimiser(const FreeFormProblem& problem);
  const FreeFormProblem& problem() const { return problem_; }

  /// The throw near `start` that is aimed at. @param reserve kept from every limit, for what happens
  /// between the moments looked at, as a share (of ranges and clearances: in rad and m).
  FreeFormSolution optimise(const Eigen::VectorXd& start, Aim aim, double reserve) const;

 private:
  /// One limit in one moment.
  struct Watched {
    int place;  ///< on the grid
    int row;
  };
  struct Round;
  FreeFormSolution assess(const Eigen::VectorXd& x, double reserve) const;
  std::vector<Watched> near(const Eigen::VectorXd& x, bool thorough) const;
  Eigen::MatrixXd limitsOnGrid(const Eigen::VectorXd& x) const;

  FreeFormProblem problem_;
  std::vector<SplineBasis::Rows> grid_, coarse_;
};

/// Every joint swings through its angle at the release with its speed there, at rest a quarter of `duration`
/// [s] before and after. Torque is left aside.
Eigen::VectorXd swingThrough(const FreeFormProblem& problem,
                             const BestRelease& release,
                             double duration);

}  // namespace fastball::bench
