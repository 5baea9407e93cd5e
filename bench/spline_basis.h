#pragma once

#include <Eigen/Core>

namespace fastball::bench {

/// Curves over s = 0..1 that rest at both ends (their slope is 0 there): B-splines of degree 5 on
/// even knots. A curve is a sum of `size()` of them. Its coordinates are not the control points: they
/// are scaled so that a step of unit length changes the curve's second derivative little wherever it
/// points, which an optimiser without second derivatives needs.
class SplineBasis {
 public:
  static constexpr int kDegree = 5;
  /// Row d: derivative d by s of each curve of the basis.
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  /// @param control_points free ones: those at the ends count once although they stand twice.
  /// @throw std::invalid_argument if there are fewer than 4.
  explicit SplineBasis(int control_points);

  int size() const { return static_cast<int>(from_coordinates_.rows()); }
  /// @param s in [0, 1]
  Rows at(double s) const;
  /// Coordinates of the curve that comes nearest to `values`, one for each of the places s.
  Eigen::VectorXd fit(const Eigen::VectorXd& s, const Eigen::VectorXd& values) const;

 private:
  Rows ofControlPoints(double s) const;
  Eigen::RowVectorXd knots_;
  Eigen::MatrixXd from_coordinates_;  ///< control points = from_coordinates_ * coordinates
};

}  // namespace fastball::bench
