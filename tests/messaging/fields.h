#pragma once

#include <cstddef>
#include <vector>

#include "lcmtypes/fastball_types.h"

/// Every floating-point number of a message, so that a test can spoil each in turn.
namespace fastball::messaging::examples {

inline void collect(std::vector<double*>& all, double& value) {
  all.push_back(&value);
}
template <class T, std::size_t N>
void collect(std::vector<double*>& all, T (&values)[N]) {
  for (T& value : values)
    collect(all, value);
}
template <class T>
void collect(std::vector<double*>& all, std::vector<T>& values) {
  for (T& value : values)
    collect(all, value);
}
template <class... Fields>
std::vector<double*> of(Fields&... fields) {
  std::vector<double*> all;
  (collect(all, fields), ...);
  return all;
}

inline std::vector<double*> numbers(arm_state_t& m) {
  return of(m.q, m.qd, m.tau);
}
inline std::vector<double*> numbers(arm_command_t& m) {
  return of(m.tau);
}
inline std::vector<double*> numbers(hand_state_t& m) {
  return of(m.q, m.qd, m.tau, m.f_normal, m.f_tangential);
}
inline std::vector<double*> numbers(hand_command_t& m) {
  return of(m.q, m.qd, m.tau, m.kp, m.kd);
}
inline std::vector<double*> numbers(scene_t& m) {
  return of(m.q_arm, m.duration, m.camera_start, m.camera_end, m.p_WTarget, m.n_WTarget,
            m.target_radius);
}
inline std::vector<double*> numbers(throw_start_t& /*m*/) {
  return {};
}
inline std::vector<double*> numbers(estop_t& /*m*/) {
  return {};
}
inline std::vector<double*> numbers(plan_request_t& m) {
  return of(m.q_arm, m.p_WTarget, m.n_WTarget, m.target_radius, m.biases);
}
inline std::vector<double*> numbers(swing_plan_t& m) {
  return of(m.plan_ms, m.t_ready, m.t_swing, m.t_swing_end, m.t_release_command, m.t_release,
            m.release_window, m.residual_acceleration, m.p_WBall_release, m.v_WBall_release,
            m.landing, m.flight_time, m.q_wrist, m.grip_force, m.parameters, m.dt, m.q, m.qd,
            m.qdd);
}
inline std::vector<double*> numbers(controller_status_t& m) {
  return of(m.q_error, m.qd_error, m.q_error_max);
}
inline std::vector<double*> numbers(grip_t& m) {
  return of(m.grip_force, m.p_HBall, m.youngs_modulus);
}
inline std::vector<double*> numbers(release_t& m) {
  return of(m.f_normal, m.grip_force, m.p_HBall, m.youngs_modulus, m.dead_time);
}
inline std::vector<double*> numbers(image_t& /*m*/) {
  return {};
}
inline std::vector<double*> numbers(camera_info_t& m) {
  return of(m.K, m.D, m.R_CW, m.p_CW, m.rate, m.exposure);
}
inline std::vector<double*> numbers(sim_truth_t& m) {
  return of(m.p_WBall, m.v_WBall, m.w_WBall, m.q_arm, m.landing);
}
inline std::vector<double*> numbers(ball_observation_t& m) {
  return of(m.u, m.v, m.radius, m.cov_uv);
}
inline std::vector<double*> numbers(ball_track_t& m) {
  return of(m.p_WBall, m.v_WBall, m.drag, m.landing, m.cov_landing);
}
inline std::vector<double*> numbers(landing_t& m) {
  return of(m.landing, m.cov_landing, m.v_WBall, m.residual_px);
}
inline std::vector<double*> numbers(logger_status_t& /*m*/) {
  return {};
}
inline std::vector<double*> numbers(heartbeat_t& m) {
  return of(m.loop_mean_us, m.loop_max_us);
}

inline std::vector<double*> numbers(clock_probe_t& /*m*/) {
  return {};
}

}  // namespace fastball::messaging::examples
