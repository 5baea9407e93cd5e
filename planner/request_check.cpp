#include "planner/request_check.h"

#include <fmt/format.h>

#include <cmath>

namespace fastball::planner {
namespace {

constexpr const char* kStrategies = "paper";
constexpr double kUnit = 1e-3;      // of a unit vector's length
constexpr double kSteepest = 0.05;  // horizontal part of the normal, at least

std::optional<std::string> targetFault(const model::Target& target) {
  if (!(target.radius > 0)) {
    return fmt::format("the target's radius is {:.4g} m, it must be positive", target.radius);
  }
  if (std::abs(target.n_WTarget.norm() - 1) > kUnit) {
    return fmt::format("the target's normal has the length {:.4g}, it must have 1",
                       target.n_WTarget.norm());
  }
  if (target.n_WTarget.head<2>().norm() < kSteepest) {
    return "the target's normal is vertical, the net must not lie flat";
  }
  if (target.distance(Eigen::Vector3d::Zero()) <= 0) {
    return "the target's normal points away from the robot";
  }
  return {};
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

std::optional<std::string> requestFault(const ThrowRequest& request,
                                        const model::ArmParameters& arm,
                                        const Eigen::Vector3d& p_TBall) {
  const model::Target& target = request.target;
  if (request.strategy != "paper") {
    return fmt::format("the strategy '{}' is not known, known strategies: {}", request.strategy,
                       kStrategies);
  }
  if (!target.p_WTarget.allFinite() || !target.n_WTarget.allFinite() ||
      !std::isfinite(target.radius) || !request.q_arm.allFinite()) {
    return "the request has a number that is not finite";
  }
  if (auto fault = targetFault(target))
    return fault;
  if (auto fault = poseFault(request.q_arm, arm))
    return fault;
  const double distance = target.p_WTarget.norm(), reach = armReach(arm, p_TBall) + target.radius;
  if (distance < reach) {
    return fmt::format(
        "the target is {:.3g} m from the shoulder, within the {:.3g} m that arm and ring reach "
        "together: there is nothing to throw",
        distance, reach);
  }
  return {};
}

}  // namespace fastball::planner
