#pragma once

#include <vector>

#include "lcmtypes/fastball_types.h"

/// One valid message of every type, with its variable parts filled.
namespace fastball::messaging::examples {

template <class T>
T example();

template <>
inline arm_state_t example() {
  arm_state_t m{};
  m.utime = 1000;
  m.seq = 1;
  m.scene_id = 1;
  m.tick = 1;
  m.q[0] = 0.5;
  return m;
}

template <>
inline arm_command_t example() {
  arm_command_t m{};
  m.phase = arm_command_t::SWING;
  m.tau[3] = -2.5;
  return m;
}

template <>
inline hand_state_t example() {
  hand_state_t m{};
  m.f_normal[1] = 3;
  m.f_tangential[2][1] = -0.1;
  return m;
}

template <>
inline hand_command_t example() {
  hand_command_t m{};
  m.phase = hand_command_t::RELEASE;
  m.kp[9] = 20;
  return m;
}

template <>
inline scene_t example() {
  scene_t m{};
  m.scene_id = 1;
  m.seed = -7;
  m.set_up_seed = 7;
  m.duration = 3;
  m.camera_start = 1;
  m.camera_end = 2;
  m.n_WTarget[0] = -1;
  m.target_radius = 0.1;
  return m;
}

template <>
inline throw_start_t example() {
  throw_start_t m{};
  m.plan_id = 1;
  m.scene_id = 1;
  m.start_utime = 600000;
  return m;
}

template <>
inline estop_t example() {
  estop_t m{};
  m.reason = "a hand on the red button";
  return m;
}

template <>
inline plan_request_t example() {
  plan_request_t m{};
  m.request_id = 1;
  m.strategy = "paper";
  m.p_WTarget[0] = 3;
  m.n_WTarget[0] = -1;
  m.target_radius = 0.1;
  return m;
}

template <>
inline swing_plan_t example() {
  swing_plan_t m{};
  m.plan_id = 1;
  m.strategy = "paper";
  m.message = "as asked";
  m.release_window[1] = 0.002;
  m.n_parameters = 2;
  m.parameter_names = {"gamma", "p1"};
  m.parameters = {0.5, -1};
  m.dt = 0.01;
  m.n_samples = 3;
  m.q.assign(3, std::vector<double>(4, 0.25));
  m.qd.assign(3, std::vector<double>(4, 0));
  m.qdd.assign(3, std::vector<double>(4, 0));
  return m;
}

template <>
inline controller_status_t example() {
  controller_status_t m{};
  m.phase = arm_command_t::BRAKE;
  m.message = "ESTOP";
  return m;
}

template <>
inline grip_t example() {
  grip_t m{};
  m.plan_id = 1;
  m.scene_id = 1;
  m.grip_force = 6;
  m.p_HBall[2] = 0.15;
  m.youngs_modulus = 5e5;
  return m;
}

template <>
inline release_t example() {
  release_t m{};
  m.event = release_t::DEPARTED;
  m.planned_utime = 1500000;
  return m;
}

template <>
inline image_t example() {
  image_t m{};
  m.width = 4;
  m.height = 3;
  m.row_stride = 4;
  m.pixelformat = image_t::GRAY;
  m.size = 12;
  m.data.assign(12, 128);
  return m;
}

template <>
inline camera_info_t example() {
  camera_info_t m{};
  m.channel = "CAMERA_LEFT";
  m.width = 640;
  m.height = 480;
  m.rate = 240;
  return m;
}

template <>
inline sim_truth_t example() {
  sim_truth_t m{};
  m.event = sim_truth_t::FINISHED;
  m.event_index = 3;
  m.note = "the ball lies still";
  return m;
}

template <>
inline ball_observation_t example() {
  ball_observation_t m{};
  m.channel = "CAMERA_RIGHT";
  m.found = 1;
  m.cov_uv[1] = -0.1;
  return m;
}

template <>
inline ball_track_t example() {
  ball_track_t m{};
  m.n_observations = 12;
  return m;
}

template <>
inline landing_t example() {
  landing_t m{};
  m.request_id = 1;
  m.message = "too few images";
  return m;
}

template <>
inline logger_status_t example() {
  logger_status_t m{};
  m.path = "throw.lcmlog";
  return m;
}

template <>
inline heartbeat_t example() {
  heartbeat_t m{};
  m.name = "planner";
  m.host = "bench";
  m.pid = 17;
  m.version = "0.1.0";
  m.state = "idle";
  m.detail = "waits for a request";
  return m;
}

template <>
inline clock_probe_t example() {
  clock_probe_t m{};
  m.utime = 30;
  m.name = "planner";
  m.host = "bench";
  m.pid = 17;
  m.asker_host = "desk";
  m.asker_pid = 18;
  m.asked_utime = 10;
  m.heard_utime = 20;
  return m;
}

}  // namespace fastball::messaging::examples
