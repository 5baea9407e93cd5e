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

/// The centres of all views for each parameter one step ahead and behind: 14 flights.
std::vector<std::vector<Eigen::Vector2d>> centresAround(const Parameters& x,
                                                        const std::vector<View>& views,
                                                        const std::vector<model::Camera>& cameras,
                                                        const FlightKnowledge& knowledge) {
  std::vector<std::vector<Eigen::Vector2d>> centres;
  for (int k = 0; k < 14; ++k) {
    Parameters y = x;
    y[k / 2] += k % 2 == 0 ? kStep : -kStep;
    model::BallState state = stateOf(y);
    double time = 0;
    std::vector<Eigen::Vector2d> seen;
    for (const View& view : views) {
      state = model::fly(state, view.time - time, y[6], knowledge.gravity);
      time = view.time;
      seen.push_back(vision_tracker::outlineCentre(
          cameras.at(static_cast<std::size_t>(view.camera)), state.p_WBall, knowledge.ball_radius));
    }
    centres.push_back(seen);
  }
  return centres;
}

}  // namespace

Eigen::Matrix2d landingBound(const model::BallState& start,
                             const std::vector<View>& views,
                             const std::vector<model::Camera>& cameras,
                             const model::Target& target,
                             const FlightKnowledge& knowledge) {
  Parameters x;
  x << start.p_WBall, start.v_WBall, knowledge.drag;
  Eigen::Matrix<double, 7, 7> information = Eigen::Matrix<double, 7, 7>::Zero();
  const std::vector<std::vector<Eigen::Vector2d>> centres =
      centresAround(x, views, cameras, knowledge);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Eigen::Matrix<double, 2, 7> jacobian;
    for (std::size_t k = 0; k < 7; ++k)
      jacobian.col(static_cast<Eigen::Index>(k)) =
          (centres[2 * k][i] - centres[2 * k + 1][i]) / (2 * kStep);
    information += jacobian.transpose() * jacobian / (views[i].sigma * views[i].sigma);
  }
  information(6, 6) += 1 / (knowledge.drag_sigma * knowledge.drag_sigma);
  const auto landing = derivative(x, [&](const Parameters& y) -> Eigen::Vector2d {
    const auto crossing = model::land(stateOf(y), target, y[6], knowledge.gravity);
    if (!crossing)
      throw std::invalid_argument("the flight does not reach the target plane");
    return crossing->landing;
  });
  const Eigen::LDLT<Eigen::Matrix<double, 7, 7>> factor(information);
  constexpr double kSingular = 1e-13;
  if (!(factor.vectorD().minCoeff() > kSingular * factor.vectorD().maxCoeff()))
    throw std::invalid_argument("the views do not determine the flight");
  return landing * factor.solve(landing.transpose());
}

}  // namespace fastball::bench
