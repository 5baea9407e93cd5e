#include "planner/request_check.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "model/grasp.h"

namespace fastball::planner {
namespace {

constexpr const char* kStrategies = "paper, robust, tactile, adaptive";
constexpr double kUnit = 1e-3;  // of a unit vector's length

std::optional<std::string> targetFault(const model::Target& target) {
  if (!(target.radius > 0)) {
    return fmt::format("the target's radius is {:.4g} m, it must be positive", target.radius);
  }
  if (std::abs(target.n_WTarget.norm() - 1) > kUnit) {
    return fmt::format("the target's normal has the length {:.4g}, it must have 1",
                       target.n_WTarget.norm());
  }
  return {};
}

/// A number that must be finite and inside a range.
struct Bounded {
  std::string name;
  double value;
  double low, high;
};

std::vector<Bounded> armNumbers(const model::ArmParameters& arm) {
  std::vector<Bounded> numbers{{"gravity [m/s^2]", arm.gravity, 0, 100},
                               {"margin to the joints' stops [rad]", arm.position_margin, 0, 1}};
  for (int j = 0; j < model::kArmJoints; ++j) {
    const auto of = [&](const char* what) { return fmt::format("{} of joint {}", what, j + 1); };
    numbers.push_back({of("speed limit [rad/s]"), arm.qd_max[j], 0.01, 1000});
    numbers.push_back({of("torque limit [N m]"), arm.tau_max[j], 0.01, 1e5});
    numbers.push_back({of("lower stop [rad]"), arm.q_min[j], -100, arm.q_max[j]});
    numbers.push_back({of("upper stop [rad]"), arm.q_max[j], arm.q_min[j], 100});
    numbers.push_back({of("drive inertia [kg m^2]"), arm.drive_inertia[j], 0, 100});
    numbers.push_back({of("viscous friction [N m s/rad]"), arm.viscous_friction[j], 0, 1000});
    numbers.push_back({of("Coulomb friction [N m]"), arm.coulomb_friction[j], 0, 1000});
    numbers.push_back({fmt::format("mass of link {} [kg]", j + 1), arm.links[j].mass, 0, 1000});
  }
  return numbers;
}

std::vector<Bounded> ballNumbers(const model::BallParameters& ball) {
  return {{"ball's radius [m]", ball.radius, 1e-3, 1},
          {"ball's mass [kg]", ball.mass, 1e-4, 10},
          {"ball's drag coefficient", ball.drag_coefficient, 0, 10},
          {"air's density [kg/m^3]", ball.air_density, 0, 100},
          {"ball's Young's modulus [Pa]", ball.youngs_modulus, 1, 1e12},
          {"ball's damping ratio", ball.damping_ratio, 0, 10},
          {"ball's friction", ball.friction, 0, 100}};
}

std::vector<Bounded> plannerNumbers(const PlannerConfig& config) {
  return {{"limit_share", config.limit_share, 0.01, 1},
          {"robust.limit_share", config.robust.limit_share, 0.01, 1},
          {"landing_tolerance [m]", config.landing_tolerance, 1e-6, 1},
          {"sample_time [s]", config.motion.sample_time, 1e-3, 0.1},
          {"approach_speed", config.motion.approach_speed, 1e-3, 1},
          {"ready_time [s]", config.motion.ready_time, 0, 100},
          {"grip_force [N]", config.grip_force, 1e-3, 1000},
          {"floor [m]", config.floor, -1e3, 1e3}};
}

std::optional<std::string> poseFault(const Eigen::Vector4d& q, const model::ArmParameters& arm) {
  for (int j = 0; j < model::kArmJoints; ++j) {
    const double low = arm.q_min[j] + arm.position_margin;
    const double high = arm.q_max[j] - arm.position_margin;
    if (q[j] < low || q[j] > high) {
      return fmt::format(
          "the arm rests with joint {} at {:.4g} rad, a plan may begin between {:.4g} and {:.4g} "
          "rad (the joint's stops less {:.3g} rad)",
          j + 1, q[j], low, high, arm.position_margin);
    }
  }
  return {};
}

}  // namespace

double armReach(const model::ArmParameters& arm, const Eigen::Vector3d& p_TBall) {
  return arm.dh[2].d + arm.tool_plate_distance + p_TBall.norm();
}

std::optional<std::string> configFault(const PlannerConfig& config) {
  for (const auto& numbers :
       {armNumbers(config.arm), ballNumbers(config.ball), plannerNumbers(config)}) {
    for (const Bounded& number : numbers) {
      if (!(number.value >= number.low && number.value <= number.high)) {
        return fmt::format(
            "no throw can be planned for the arm {}: the {} is {:.4g}, it must be "
            "between {:.4g} and {:.4g}",
            config.arm.profile, number.name, number.value, number.low, number.high);
      }
    }
  }
  try {
    model::grasp(config.ball, model::Hand(config.hand), config.grip_force);
  } catch (const std::invalid_argument& e) {
    return fmt::format("no throw can be planned: {}", e.what());
  }
  return {};
}

std::optional<std::string> requestFault(const ThrowRequest& request, const PlannerConfig& config) {
  const model::Target& target = request.target;
  if (request.strategy != "paper" && !seeksWindow(request.strategy)) {
    return fmt::format("the strategy '{}' is not known, known strategies: {}", request.strategy,
                       kStrategies);
  }
  if (!target.p_WTarget.allFinite() || !target.n_WTarget.allFinite() ||
      !std::isfinite(target.radius) || !request.q_arm.allFinite()) {
    return "the request has a number that is not finite";
  }
  if (auto fault = targetFault(target))
    return fault;
  if (auto fault = poseFault(request.q_arm, config.arm))
    return fault;
  const double distance = target.p_WTarget.norm(),
               reach = armReach(config.arm, config.hand.p_HBall) + target.radius;
  if (distance < reach) {
    return fmt::format(
        "the target is {:.3g} m from the shoulder, within the {:.3g} m that arm and ring reach "
        "together: there is nothing to throw",
        distance, reach);
  }
  if (target.p_WTarget.z() < config.floor) {
    return fmt::format("the target is at z = {:.3g} m, under the floor at {:.3g} m",
                       target.p_WTarget.z(), config.floor);
  }
  return {};
}

}  // namespace fastball::planner
