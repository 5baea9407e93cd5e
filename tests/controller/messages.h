#pragma once

#include <algorithm>

#include "controller/plan.h"
#include "messaging/channels.h"

namespace fastball::controller {

/// A plan as SWING_PLAN carries it.
inline swing_plan_t planMessage(const Plan& plan) {
  swing_plan_t message{};
  message.plan_id = plan.id;
  message.strategy = "test";
  message.t_ready = plan.t_ready;
  message.t_swing = plan.t_swing;
  message.t_swing_end = plan.t_swing_end;
  message.dt = plan.trajectory.dt();
  message.n_samples = static_cast<int32_t>(plan.trajectory.samples().size());
  const auto row = [](const Eigen::Vector4d& v) {
    return std::vector<double>(v.data(), v.data() + model::kArmJoints);
  };
  for (const model::ArmMotion& sample : plan.trajectory.samples()) {
    message.q.push_back(row(sample.q));
    message.qd.push_back(row(sample.qd));
    message.qdd.push_back(row(sample.qdd));
  }
  return message;
}

inline throw_start_t startMessage(int64_t plan_id, int64_t scene_id, int64_t start_utime) {
  throw_start_t message{};
  message.plan_id = plan_id;
  message.scene_id = scene_id;
  message.start_utime = start_utime;
  return message;
}

/// The arm's state at a tick of a scene that begins at 0.
inline arm_state_t stateMessage(int64_t scene_id,
                                int64_t tick,
                                const Eigen::Vector4d& q,
                                const Eigen::Vector4d& qd) {
  arm_state_t message{};
  message.utime = 1000 * tick;
  message.scene_id = scene_id;
  message.tick = tick;
  std::copy_n(q.data(), model::kArmJoints, message.q);
  std::copy_n(qd.data(), model::kArmJoints, message.qd);
  return message;
}

}  // namespace fastball::controller
