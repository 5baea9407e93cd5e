#include "bench/flight_bound.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "vision_tracker/sphere_outline.h"

namespace fastball::bench {
namespace {

/// Position, velocity, drag.
using Parameters = Eigen::Matrix<double, 7, 1>;

constexpr double kStep =
    1e-5;  // [m], [m/s], [1/m], of the differences: their errors are below 1e-7 of the derivatives

model::BallState stateOf(const Parameters& x) {
  return {x.head<3>(), x.segment<3>(3)};
}

/// d function / d parameters, of a function of two values.
template <typename Function>
Eigen::Matrix<double, 2, 7> derivative(const Parameters& x, const Function& function) {
  Eigen::Matrix<double, 2, 7> result;
  for (int i = 0; i < 7; ++i) {
    Parameters ahead = x, behind = x;
    ahead[i] += kStep;
    behind[i] -= kStep;
    result.col(i) = (function(ahead) - function(behind)) / (2 * kStep);
  }
  return result;
}

/// The centres of all views, each `late` [s] later than it says.
std::vector<Eigen::Vector2d> centresOf(const Parameters& x,
                                       double late,
                                       const std::vector<View>& views,
                                       const std::vector<model::Camera>& cameras,
                                       const FlightKnowledge& knowledge) {
  model::BallState state = stateOf(x);
  double time = 0;
  std::vector<Eigen::Vector2d> seen;
  for (const View& view : views) {
    state = model::fly(state, view.time + late - time, x[6], knowledge.gravity);
    time = view.time + late;
    seen.push_back(vision_tracker::outlineCentre(cameras.at(static_cast<std::size_t>(view.camera)),
                                                 state.p_WBall, knowledge.ball_radius));
  }
  return seen;
}

/// d centre / d (parameters, clocks) of all views, by 2 x 8 flights.
std::vector<Eigen::MatrixXd> jacobiansOf(const Parameters& x,
                                         const std::vector<View>& views,
                                         const std::vector<model::Camera>& cameras,
                                         const FlightKnowledge& knowledge) {
  const bool clocks = knowledge.clock_sigma > 0;
  const auto columns = static_cast<Eigen::Index>(clocks ? 7 + cameras.size() - 1 : 7);
  std::vector<Eigen::MatrixXd> jacobians(views.size(), Eigen::MatrixXd::Zero(2, columns));
  for (int k = 0; k <= (clocks ? 7 : 6); ++k) {
    Parameters step = Parameters::Zero();
    if (k < 7)
      step[k] = kStep;
    const double late = k < 7 ? 0 : kStep;
    const auto ahead = centresOf(x + step, late, views, cameras, knowledge);
    const auto behind = centresOf(x - step, -late, views, cameras, knowledge);
    for (std::size_t i = 0; i < views.size(); ++i) {
      // A clock that is ahead makes a view earlier than it says.
      if (k < 7)
        jacobians[i].col(k) = (ahead[i] - behind[i]) / (2 * kStep);
      else if (views[i].camera > 0)
        jacobians[i].col(6 + views[i].camera) = (behind[i] - ahead[i]) / (2 * kStep);
    }
  }
  return jacobians;
}

}  // namespace

Eigen::Matrix2d landingBound(const model::BallState& start,
                             const std::vector<View>& views,
                             const std::vector<model::Camera>& cameras,
                             const model::Target& target,
                             const FlightKnowledge& knowledge) {
  Parameters x;
  x << start.p_WBall, start.v_WBall, knowledge.drag;
  const std::vector<Eigen::MatrixXd> jacobians = jacobiansOf(x, views, cameras, knowledge);
  if (jacobians.empty())
    throw std::invalid_argument("the views do not determine the flight");
  const Eigen::Index size = jacobians.front().cols();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < views.size(); ++i)
    information += jacobians[i].transpose() * jacobians[i] / (views[i].sigma * views[i].sigma);
  for (Eigen::Index i = 7; i < size; ++i)
    information(i, i) += 1 / (knowledge.clock_sigma * knowledge.clock_sigma);
  information(6, 6) += 1 / (knowledge.drag_sigma * knowledge.drag_sigma);
  Eigen::MatrixXd landing = Eigen::MatrixXd::Zero(2, size);
  landing.leftCols<7>() = derivative(x, [&](const Parameters& y) -> Eigen::Vector2d {
    const auto crossing = model::land(stateOf(y), target, y[6], knowledge.gravity);
    if (!crossing)
      throw std::invalid_argument("the flight does not reach the target plane");
    return crossing->landing;
  });
  const Eigen::LDLT<Eigen::MatrixXd> factor(information);
  constexpr double kSingular = 1e-13;
  if (!(factor.vectorD().minCoeff() > kSingular * factor.vectorD().maxCoeff()))
    throw std::invalid_argument("the views do not determine the flight");
  return landing * factor.solve(landing.transpose());
}

}  // namespace fastball::bench
