#include "launch/figures/planned_swing.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "planner/planner.h"

namespace fastball::launch {

planner::Plan planPaperThrow(const FigureTask& task) {
  const planner::Planner planner(planner::loadConfig(task.config));
  planner::ThrowRequest request;
  request.strategy = "paper";
  request.q_arm = task.experiment.q_rest;
  request.target = task.experiment.target;
  request.seed = 1;
  planner::PlanResult result = planner.plan(request);
  if (const auto* refusal = std::get_if<planner::Refusal>(&result))
    throw std::runtime_error(refusal->sentence);
  return std::get<planner::Plan>(std::move(result));
}

double parameter(const planner::Plan& plan, const std::string& name) {
  for (const auto& [its_name, value] : plan.parameters) {
    if (its_name == name)
      return value;
  }
  throw std::runtime_error(fmt::format("the plan has no parameter '{}'", name));
}

Eigen::Vector3d swingSpeeds(const model::Arm& arm, const model::ArmMotion& motion) {
  const Eigen::Vector3d l = arm.X_WT(motion.q).linear().col(2);
  const Eigen::Vector3d w = arm.rotationJacobian(motion.q) * motion.qd;
  const Eigen::Vector3d ld = w.cross(l);
  const double sine = std::hypot(l.x(), l.y());
  return {motion.qd[0], -ld.z() / sine, l.cross(ld).z() / (sine * sine) - motion.qd[0]};
}

}  // namespace fastball::launch
