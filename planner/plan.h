#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/ball_flight.h"
#include "model/landing_biases.h"
#include "model/target.h"
#include "model/trajectory.h"

namespace fastball::planner {

/// What a plan is asked for.
struct ThrowRequest {
  std::string strategy;                             ///< "paper", "robust", "tactile" or "adaptive"
  Eigen::Vector4d q_arm = Eigen::Vector4d::Zero();  ///< [rad], where the arm rests
  model::Target target;
  int64_t seed = 0;  ///< of the random starts
  /// What the set-up adds to every throw, as far as is known.
  model::LandingBiases biases = model::LandingBiases::Zero();
};

/// Whether throws of a strategy go through a release window where there is one: `robust`;
/// `tactile`, the same plan with a hand that feels and learns; `adaptive`, that with an aim that
/// learns.
inline bool seeksWindow(const std::string& strategy) {
  return strategy == "robust" || strategy == "tactile" || strategy == "adaptive";
}

/// Sine of the least angle at which a ball may meet the plane of the ring, from its front.
inline constexpr double kLeastSteepness = 0.35;

/// A throw. Times [s] count from the start of the plan.
struct Plan {
  std::string strategy;
  model::SampledTrajectory trajectory;
  double t_ready = 0;            ///< approach ends
  double t_swing = 0;            ///< swing begins
  double t_swing_end = 0;        ///< follow-through begins
  double t_release_command = 0;  ///< whole millisecond
  double t_release = 0;          ///< the ball is predicted to leave
  /// In which the ball may leave. Of a swing without a window: t_release, as well as it is known.
  std::array<double, 2> release_window{};
  double residual_acceleration = 0;  ///< [m/s^2], hand minus free ball, largest in the window
  model::BallState release;          ///< ball just after it has left
  Eigen::Vector2d landing = Eigen::Vector2d::Zero();  ///< [m], target plane
  double flight_time = 0;                             ///< [s]
  double wrist_roll = 0, wrist_flexion = 0;           ///< [rad]
  double grip_force = 0;                              ///< [N]
  std::vector<std::pair<std::string, double>>
      parameters;  ///< what made the trajectory, in plan time
};

/// Why no plan can be given: one sentence that names the limit, with numbers.
struct Refusal {
  std::string sentence;
};

using PlanResult = std::variant<Plan, Refusal>;

}  // namespace fastball::planner
