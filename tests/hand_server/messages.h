#pragma once

#include <algorithm>
#include <vector>

#include "hand_server/hand_controller.h"
#include "messaging/channels.h"

namespace fastball::hand_server {

/// A plan as SWING_PLAN carries it.
inline swing_plan_t planMessage(const HandPlan& plan) {
  swing_plan_t message{};
  message.plan_id = plan.id;
  message.strategy = "test";
  message.t_swing = plan.t_swing;
  message.t_swing_end = plan.arm.duration();
  message.t_release_command = plan.t_release_command;
  message.t_release = plan.t_release;
  message.release_window[0] = plan.t_release - plan.window / 2;
  message.release_window[1] = plan.t_release + plan.window / 2;
  message.grip_force = plan.grip_force;
  std::copy_n(plan.q_wrist.data(), 2, message.q_wrist);
  message.dt = plan.arm.dt();
  message.n_samples = static_cast<int32_t>(plan.arm.samples().size());
  const auto row = [](const Eigen::Vector4d& v) {
    return std::vector<double>(v.data(), v.data() + model::kArmJoints);
  };
  for (const model::ArmMotion& sample : plan.arm.samples()) {
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

/// The hand's state at a tick of a scene that begins at 0, with the same force at each finger.
inline hand_state_t stateMessage(int64_t scene_id,
                                 int64_t tick,
                                 const model::HandVector& q,
                                 const model::HandVector& qd,
                                 double force) {
  hand_state_t message{};
  message.utime = 1000 * tick;
  message.scene_id = scene_id;
  message.tick = tick;
  std::copy_n(q.data(), model::kHandJoints, message.q);
  std::copy_n(qd.data(), model::kHandJoints, message.qd);
  std::fill_n(message.f_normal, model::kFingers, force);
  return message;
}

/// What a HAND_COMMAND asks for.
inline HandAnswer answerOf(const hand_command_t& command) {
  HandAnswer answer;
  answer.q = Eigen::Map<const model::HandVector>(command.q);
  answer.qd = Eigen::Map<const model::HandVector>(command.qd);
  answer.tau = Eigen::Map<const model::HandVector>(command.tau);
  answer.kp = Eigen::Map<const model::HandVector>(command.kp);
  answer.kd = Eigen::Map<const model::HandVector>(command.kd);
  return answer;
}

}  // namespace fastball::hand_server
