#include "planner/plan_message.h"

#include <algorithm>
#include <vector>

#include "messaging/validation.h"

namespace fastball::planner {
namespace {

std::vector<double> row(const Eigen::Vector4d& v) {
  return {v.data(), v.data() + v.size()};
}

void putTrajectory(const model::SampledTrajectory& trajectory, swing_plan_t& message) {
  message.dt = trajectory.dt();
  message.n_samples = static_cast<int32_t>(trajectory.samples().size());
  for (const model::ArmMotion& sample : trajectory.samples()) {
    message.q.push_back(row(sample.q));
    message.qd.push_back(row(sample.qd));
    message.qdd.push_back(row(sample.qdd));
  }
}

void putPlan(const Plan& plan, swing_plan_t& message) {
  message.t_ready = plan.t_ready;
  message.t_swing = plan.t_swing;
  message.t_swing_end = plan.t_swing_end;
  message.t_release_command = plan.t_release_command;
  message.t_release = plan.t_release;
  std::copy_n(plan.release_window.data(), 2, message.release_window);
  message.residual_acceleration = plan.residual_acceleration;
  std::copy_n(plan.release.p_WBall.data(), 3, message.p_WBall_release);
  std::copy_n(plan.release.v_WBall.data(), 3, message.v_WBall_release);
  std::copy_n(plan.landing.data(), 2, message.landing);
  message.flight_time = plan.flight_time;
  message.q_wrist[0] = plan.wrist_roll;
  message.q_wrist[1] = plan.wrist_flexion;
  message.grip_force = plan.grip_force;
  message.n_parameters = static_cast<int32_t>(plan.parameters.size());
  for (const auto& [name, value] : plan.parameters) {
    message.parameter_names.push_back(name);
    message.parameters.push_back(value);
  }
  putTrajectory(plan.trajectory, message);
}

}  // namespace

ThrowRequest fromMessage(const plan_request_t& message) {
  ThrowRequest request;
  request.strategy = message.strategy;
  request.seed = message.seed;
  request.q_arm = Eigen::Map<const Eigen::Vector4d>(message.q_arm);
  request.target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(message.p_WTarget);
  request.target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(message.n_WTarget);
  request.target.radius = message.target_radius;
  request.biases = Eigen::Map<const model::LandingBiases>(message.biases);
  return request;
}

swing_plan_t toMessage(const PlanResult& result, const plan_request_t& request) {
  swing_plan_t message{};
  message.utime = request.utime;
  message.plan_id = request.request_id;
  message.strategy = request.strategy;
  if (const Refusal* refusal = std::get_if<Refusal>(&result)) {
    message.status = swing_plan_t::REFUSED;
    message.message = messaging::shortened(refusal->sentence);
    return message;
  }
  message.status = swing_plan_t::OK;
  putPlan(std::get<Plan>(result), message);
  return message;
}

}  // namespace fastball::planner
