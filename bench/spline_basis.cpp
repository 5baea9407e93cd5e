#include "bench/spline_basis.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/Splines>

namespace fastball::bench {
namespace {

using Spline = Eigen::Spline<double, 1, SplineBasis::kDegree>;

constexpr int kLeast = 4;
// A step that changes the curve by 1 counts as much as one that changes its second derivative by this.
constexpr double kBend = 20;
constexpr int kGramPlaces = 400;

}  // namespace

SplineBasis::SplineBasis(int control_points) {
  if (control_points < kLeast) {
    throw std::invalid_argument("a joint's curve needs at least " + std::to_string(kLeast) +
                                " control points, not " + std::to_string(control_points));
  }
  const int all = control_points + 2, spans = all - kDegree;
  knots_.resize(all + kDegree + 1);
  for (int i = 0; i < knots_.size(); ++i)
    knots_[i] = std::clamp(static_cast<double>(i - kDegree) / spans, 0.0, 1.0);
  from_coordinates_ = Eigen::MatrixXd::Identity(control_points, control_points);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(control_points, control_points);
  for (int i = 0; i <= kGramPlaces; ++i) {
    const Rows rows = ofControlPoints(static_cast<double>(i) / kGramPlaces);
    gram += rows.row(0).transpose() * rows.row(0) +
            rows.row(2).transpose() * rows.row(2) / (kBend * kBend);
  }
  gram /= kGramPlaces + 1;
  from_coordinates_ =
      gram.llt().matrixU().solve(Eigen::MatrixXd::Identity(control_points, control_points));
}

SplineBasis::Rows SplineBasis::ofControlPoints(double s) const {
  const int all = static_cast<int>(knots_.size()) - kDegree - 1;
  const auto nonzero = Spline::BasisFunctionDerivatives(s, 2, kDegree, knots_);
  const auto first = Spline::Span(s, kDegree, knots_) - kDegree;
  Rows of_all = Rows::Zero(3, all);
  of_all.middleCols(first, kDegree + 1) = nonzero;
  Rows rows = of_all.middleCols(1, all - 2);
  rows.col(0) += of_all.col(0);
  rows.col(all - 3) += of_all.col(all - 1);
  return rows;
}

SplineBasis::Rows SplineBasis::at(double s) const {
  return ofControlPoints(s) * from_coordinates_;
}

Eigen::VectorXd SplineBasis::fit(const Eigen::VectorXd& s, const Eigen::VectorXd& values) const {
  Eigen::MatrixXd rows(s.size(), size());
  for (int i = 0; i < s.size(); ++i)
    rows.row(i) = at(s[i]).row(0);
  return rows.colPivHouseholderQr().solve(values);
}

}  // namespace fastball::bench
