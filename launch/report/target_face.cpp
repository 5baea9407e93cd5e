#include "launch/report/target_face.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace fastball::launch {
namespace {

constexpr double kChiSquare95 = 5.991;  // of two degrees of freedom

Eigen::Matrix2d covarianceOf(const landing_t& landing) {
  Eigen::Matrix2d covariance;
  covariance << landing.cov_landing[0], landing.cov_landing[1], landing.cov_landing[1],
      landing.cov_landing[2];
  return covariance;
}

}  // namespace

std::string ellipse95(const landing_t& landing) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covarianceOf(landing));
  const Eigen::Matrix2d spread =
      axes.eigenvectors() *
      (kChiSquare95 * axes.eigenvalues().cwiseMax(0)).cwiseSqrt().asDiagonal();
  std::string outline;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * M_PI / 36;
    const Eigen::Vector2d p = spread * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    outline += fmt::format("{:.4f} {:.4f}\n", 1e3 * (landing.landing[0] + p.x()),
                           1e3 * (landing.landing[1] + p.y()));
  }
  return outline;
}

Eigen::Vector2d extent95(const landing_t& landing) {
  return (kChiSquare95 * covarianceOf(landing).diagonal()).cwiseMax(0).cwiseSqrt();
}

}  // namespace fastball::launch
