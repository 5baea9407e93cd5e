#include "planner/scaled_swing.h"

#include <Eigen/LU>
#include <cmath>

#include "planner/hand_motion.h"

namespace fastball::planner {
namespace {

// [1/s], of the bounds of the amplitudes: the coordinates' bounds lie beyond the speed limits.
constexpr double kFastest = 10;

/// Typical size of each coordinate.
const SwingVector& scales() {
  static const SwingVector scale = [] {
    SwingVector s;
    s << 2, 3, 0.5, 0.5, 3, 5, 0.02, 0.5, 3, 3, 0.5, 0.5, 2, 3, 0.5, 0.5, 0.5, 0.5, 0.5;
    return s;
  }();
  return scale;
}

/// Bounds of the coordinates from those of the parameters.
SwingVector coordinateBounds(SwingVector bounds) {
  for (const SwingVariable i : {kAlpha1, kAmplitude2, kAlpha3, kAlphaGamma})
    bounds[i] *= kFastest;
  for (const SwingVariable i : {kC1, kC2, kC3})
    bounds[i] *= 2;
  return bounds;
}

}  // namespace

ScaledSwing::ScaledSwing(const SwingProblem& problem, const SwingVector& rest)
    : problem_(problem), rest_(rest) {
  for (int i = 0; i < kSwingVariables; ++i) {
    if (problem.lower()[i] == problem.upper()[i])
      rest_[i] = problem.lower()[i];
    if (problem.isFree(i) && i != kWristRoll && i != kWristFlexion)
      free_.push_back(i);
  }
  rest_ = coordinatesOf(rest_);
}

std::vector<double> ScaledSwing::scaled(const SwingVector& coordinates) const {
  std::vector<double> u;
  for (const int i : free_)
    u.push_back(coordinates[i] / scales()[i]);
  return u;
}

std::vector<double> ScaledSwing::lower() const {
  return scaled(coordinateBounds(problem_.lower()));
}

std::vector<double> ScaledSwing::upper() const {
  return scaled(coordinateBounds(problem_.upper()));
}

SwingVector ScaledSwing::parameters(const double* u) const {
  SwingVector y = rest_;
  for (std::size_t k = 0; k < free_.size(); ++k)
    y[free_[k]] = u[k] * scales()[free_[k]];
  SwingVector x = parametersOf(y);
  const SwingTask& task = problem_.task();
  const model::ArmMotion release = SwingCurve(x, problem_.elbowSign()).at(0);
  const WristAngles wrist = throwDirection(*task.arm, *task.hand, release).wrist;
  x[kWristRoll] = wrist.roll;
  x[kWristFlexion] = wrist.flexion;
  return x;
}

const ScaledSwing::Values& ScaledSwing::values(const double* u) {
  if (!known_.empty() && std::equal(known_.begin(), known_.end(), u))
    return values_;
  known_.assign(u, u + free_.size());
  has_gradients_ = false;
  x_ = parameters(u);
  problem_values_ = problem_.evaluate(x_);
  values_.release_speed = problem_values_.release_speed;
  values_.flight_time = x_[kFlightTime];
  values_.inequalities = problem_values_.inequalities;
  values_.equalities =
      problem_values_.equalities.segment(ReleaseConditions::kDirectionEqualities, equalityCount());
  values_.finite = std::isfinite(problem_values_.violation());
  return values_;
}

const ScaledSwing::Gradients& ScaledSwing::gradients(const double* u) {
  values(u);
  if (has_gradients_)
    return gradients_;
  has_gradients_ = true;
  problem_gradients_ = problem_.gradients(x_, problem_values_);
  gradients_.release_speed =
      carried(problem_gradients_.release_speed.transpose().eval(), 0, 1).row(0);
  gradients_.flight_time = carried(SwingVector::Unit(kFlightTime).transpose().eval(), 0, 1).row(0);
  gradients_.inequalities =
      carried(problem_gradients_.inequalities, 0, static_cast<int>(inequalityCount()));
  gradients_.equalities =
      carried(problem_gradients_.equalities, ReleaseConditions::kDirectionEqualities,
              static_cast<int>(equalityCount()));
  return gradients_;
}

template <typename Rows>
ScaledSwing::Matrix ScaledSwing::carried(const Rows& by_parameters, int first, int count) const {
  // Eq. (25): E(x, wrist) = 0, so that d wrist = -(dE/dwrist)^-1 dE/dx dx.
  const auto direction =
      problem_gradients_.equalities.topRows<ReleaseConditions::kDirectionEqualities>();
  const Eigen::Matrix2d by_wrist = direction.middleCols<2>(kWristRoll);
  const Eigen::Matrix<double, 2, kSwingVariables> wrist_by_x = -by_wrist.inverse() * direction;
  const CoordinateGradient by_coordinates(x_);
  Matrix result(count, free_.size());
  for (int i = 0; i < count; ++i) {
    SwingVector row = by_parameters.row(first + i).transpose();
    row += wrist_by_x.transpose() * Eigen::Vector2d(row[kWristRoll], row[kWristFlexion]);
    row = by_coordinates(row);
    for (std::size_t k = 0; k < free_.size(); ++k)
      result(i, k) = row[free_[k]] * scales()[free_[k]];
  }
  return result;
}

}  // namespace fastball::planner
