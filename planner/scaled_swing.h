#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "planner/swing_coordinates.h"
#include "planner/swing_problem.h"

namespace fastball::planner {

/// A SwingProblem as an optimiser sees it. Its variables u are the free coordinates (coordinatesOf)
/// over their typical sizes. The wrist's angles are none of them: they follow from the motion by
/// Eq. (25), and derivatives by them are carried over to the others.
class ScaledSwing {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Values {
    double release_speed = 0;                  ///< [m/s]
    double flight_time = 0;                    ///< [s]
    Eigen::VectorXd inequalities, equalities;  ///< of the problem; of the equalities the landing
    bool finite = false;
    /// Largest violation of a constraint.
    double violation() const {
      return std::max(inequalities.maxCoeff(), equalities.lpNorm<Eigen::Infinity>());
    }
  };
  /// By u.
  struct Gradients {
    Eigen::RowVectorXd release_speed, flight_time;
    Matrix inequalities, equalities;
  };

  /// @param problem must outlive this.
  /// @param rest parameters; those which are not free keep their value.
  ScaledSwing(const SwingProblem& problem, const SwingVector& rest);

  unsigned size() const { return static_cast<unsigned>(free_.size()); }
  unsigned inequalityCount() const { return static_cast<unsigned>(problem_.inequalityCount()); }
  unsigned equalityCount() const {
    return static_cast<unsigned>(problem_.equalityCount() -
                                 ReleaseConditions::kDirectionEqualities);
  }
  std::vector<double> lower() const;
  std::vector<double> upper() const;
  std::vector<double> start() const { return scaled(rest_); }

  /// Both remember the last point asked about: NLopt asks for objective and constraints one after another.
  const Values& values(const double* u);
  const Gradients& gradients(const double* u);

  /// The parameters of Eq. (12) at u, the wrist's angles by Eq. (25).
  SwingVector parameters(const double* u) const;

 private:
  std::vector<double> scaled(const SwingVector& coordinates) const;
  /// Adds the derivatives by the wrist's angles, which follow from the rest, to those by the other parameters, and takes them to u.
  template <typename Rows>
  Matrix carried(const Rows& by_parameters, int first, int count) const;

  const SwingProblem& problem_;
  SwingVector rest_;  ///< coordinates
  std::vector<int> free_;
  std::vector<double> known_;
  SwingVector x_;
  SwingProblem::Values problem_values_;
  SwingProblem::Gradients problem_gradients_;
  Values values_;
  Gradients gradients_;
  bool has_gradients_ = false;
};

}  // namespace fastball::planner
