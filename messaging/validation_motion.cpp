#include "messaging/validation_check.h"

namespace fastball::messaging {
namespace {

constexpr int32_t kMaxSamples = 1000;
constexpr int32_t kMaxParameters = 200;
// A plan is looked through tick by tick: one that lasts for years would take as long to refuse.
constexpr double kLongestStep = 0.1;  // [s], between two samples
constexpr double kLongestPlan = 100;  // [s]
// Beyond anything that a joint measures; with them, what is computed of a state stays finite.
constexpr double kFarthestJoint = 1e3;    // [rad]
constexpr double kFastestJoint = 1e4;     // [rad/s]
constexpr double kHastiestJoint = 1e6;    // [rad/s^2]
constexpr double kStrongestJoint = 1e6;   // [Nm]
constexpr double kStrongestFinger = 1e6;  // [N]
constexpr double kFarthestBall = 1;       // [m], in the hand

template <class T>
Check& target(Check& check, const T& m) {
  return check.finite("p_WTarget", m.p_WTarget)
      .unit("n_WTarget", m.n_WTarget)
      .positive("target_radius", m.target_radius);
}

/// n rows of four joints, each no further from zero than `limit`.
Check& rows(Check& check,
            const char* field,
            const std::vector<std::vector<double>>& rows,
            int32_t n,
            double limit) {
  check.length(field, rows.size(), "n_samples", n);
  for (std::size_t i = 0; check.good() && i < rows.size(); ++i) {
    if (rows[i].size() != 4)
      check.fail("{}[{}] has {} joints, not 4", field, i, rows[i].size());
    for (std::size_t j = 0; check.good() && j < 4; ++j) {
      if (!std::isfinite(rows[i][j]))
        check.fail("{}[{}][{}] is {}", field, i, j, rows[i][j]);
      else if (std::abs(rows[i][j]) > limit)
        check.fail("{}[{}][{}] is {}, beyond {}", field, i, j, rows[i][j], limit);
    }
  }
  return check;
}

}  // namespace

std::optional<std::string> fault(const arm_state_t& m) {
  Check check("ARM_STATE");
  check.stamp(m);
  check.notNegative("scene_id", m.scene_id);
  check.notNegative("tick", m.tick);
  return check.bounded("q", m.q, kFarthestJoint)
      .bounded("qd", m.qd, kFastestJoint)
      .bounded("tau", m.tau, kStrongestJoint)
      .fault();
}

std::optional<std::string> fault(const arm_command_t& m) {
  Check check("ARM_COMMAND");
  check.stamp(m);
  check.notNegative("scene_id", m.scene_id);
  check.notNegative("tick", m.tick);
  check.notNegative("plan_id", m.plan_id);
  check.enumeration("phase", m.phase, arm_command_t::IDLE, arm_command_t::BRAKE);
  return check.finite("tau", m.tau).fault();
}

std::optional<std::string> fault(const hand_state_t& m) {
  Check check("HAND_STATE");
  check.stamp(m);
  check.notNegative("scene_id", m.scene_id);
  check.notNegative("tick", m.tick);
  return check.bounded("q", m.q, kFarthestJoint)
      .bounded("qd", m.qd, kFastestJoint)
      .bounded("tau", m.tau, kStrongestJoint)
      .positiveOrZero("f_normal", m.f_normal)
      .bounded("f_normal", m.f_normal, kStrongestFinger)
      .finite("f_tangential", m.f_tangential)
      .fault();
}

std::optional<std::string> fault(const hand_command_t& m) {
  Check check("HAND_COMMAND");
  check.stamp(m);
  check.notNegative("scene_id", m.scene_id);
  check.notNegative("tick", m.tick);
  check.notNegative("plan_id", m.plan_id);
  check.enumeration("phase", m.phase, hand_command_t::OPEN, hand_command_t::CLEAR);
  return check.finite("q", m.q)
      .finite("qd", m.qd)
      .finite("tau", m.tau)
      .positiveOrZero("kp", m.kp)
      .positiveOrZero("kd", m.kd)
      .fault();
}

std::optional<std::string> fault(const scene_t& m) {
  Check check("SCENE");
  check.stamp(m).atLeast("scene_id", m.scene_id, int64_t{1});
  check.finite("q_arm", m.q_arm)
      .positive("duration", m.duration)
      .positiveOrZero("camera_start", m.camera_start)
      .finite("camera_end", m.camera_end)
      .atLeast("camera_end", m.camera_end, m.camera_start);
  return target(check, m).fault();
}

std::optional<std::string> fault(const throw_start_t& m) {
  Check check("THROW_START");
  check.stamp(m)
      .atLeast("plan_id", m.plan_id, int64_t{1})
      .atLeast("scene_id", m.scene_id, int64_t{1});
  return check.notNegative("start_utime", m.start_utime).fault();
}

std::optional<std::string> fault(const estop_t& m) {
  return Check("ESTOP").stamp(m).sentence("reason", m.reason).fault();
}

std::optional<std::string> fault(const plan_request_t& m) {
  Check check("PLAN_REQUEST");
  check.stamp(m)
      .atLeast("request_id", m.request_id, int64_t{1})
      .name("strategy", m.strategy)
      .finite("q_arm", m.q_arm)
      .finite("biases", m.biases);
  return target(check, m).fault();
}

std::optional<std::string> fault(const swing_plan_t& m) {
  Check check("SWING_PLAN");
  check.stamp(m)
      .atLeast("plan_id", m.plan_id, int64_t{1})
      .name("strategy", m.strategy)
      .sentence("message", m.message);
  check.enumeration("status", m.status, swing_plan_t::OK, swing_plan_t::REFUSED);
  check.positiveOrZero("plan_ms", m.plan_ms)
      .within("t_ready", m.t_ready, 0.0, kLongestPlan)
      .within("t_swing", m.t_swing, 0.0, kLongestPlan)
      .within("t_swing_end", m.t_swing_end, 0.0, kLongestPlan)
      .within("t_release_command", m.t_release_command, 0.0, kLongestPlan)
      .within("t_release", m.t_release, 0.0, kLongestPlan)
      .positiveOrZero("release_window", m.release_window)
      .within("release_window[1]", m.release_window[1], m.release_window[0], kLongestPlan)
      .positiveOrZero("residual_acceleration", m.residual_acceleration)
      .finite("p_WBall_release", m.p_WBall_release)
      .finite("v_WBall_release", m.v_WBall_release)
      .finite("landing", m.landing)
      .within("flight_time", m.flight_time, 0.0, kLongestPlan)
      .finite("q_wrist", m.q_wrist)
      .positiveOrZero("grip_force", m.grip_force)
      .within<int32_t>("n_parameters", m.n_parameters, 0, kMaxParameters)
      .length("parameter_names", m.parameter_names.size(), "n_parameters", m.n_parameters)
      .length("parameters", m.parameters.size(), "n_parameters", m.n_parameters)
      .finite("parameters", m.parameters);
  for (const auto& name : m.parameter_names)
    check.name("parameter_names", name);
  // A refused plan may come without a trajectory.
  const bool follows = m.status == swing_plan_t::OK;
  check.within<int32_t>("n_samples", m.n_samples, follows ? 2 : 0, kMaxSamples);
  if (follows)
    check.positive("dt", m.dt);
  check.within("dt", m.dt, 0.0, kLongestStep);
  rows(check, "q", m.q, m.n_samples, kFarthestJoint);
  rows(check, "qd", m.qd, m.n_samples, kFastestJoint);
  return rows(check, "qdd", m.qdd, m.n_samples, kHastiestJoint).fault();
}

std::optional<std::string> fault(const controller_status_t& m) {
  Check check("CONTROLLER_STATUS");
  check.stamp(m);
  check.notNegative("plan_id", m.plan_id);
  check.notNegative("scene_id", m.scene_id);
  check.enumeration("phase", m.phase, arm_command_t::IDLE, arm_command_t::BRAKE);
  check.notNegative("stale_states", m.stale_states);
  check.notNegative("saturations", m.saturations);
  return check.finite("q_error", m.q_error)
      .finite("qd_error", m.qd_error)
      .finite("q_error_max", m.q_error_max)
      .sentence("message", m.message)
      .fault();
}

std::optional<std::string> fault(const grip_t& m) {
  Check check("GRIP");
  check.stamp(m)
      .atLeast("plan_id", m.plan_id, int64_t{1})
      .atLeast("scene_id", m.scene_id, int64_t{1});
  return check.positiveOrZero("grip_force", m.grip_force)
      .bounded("p_HBall", m.p_HBall, kFarthestBall)
      .positiveOrZero("youngs_modulus", m.youngs_modulus)
      .fault();
}

std::optional<std::string> fault(const release_t& m) {
  Check check("RELEASE");
  check.stamp(m);
  check.notNegative("plan_id", m.plan_id);
  check.notNegative("scene_id", m.scene_id);
  check.enumeration("event", m.event, release_t::COMMANDED, release_t::DEPARTED);
  check.enumeration("reason", m.reason, release_t::PLAN_TIME, release_t::NORMAL_FORCE);
  check.notNegative("planned_utime", m.planned_utime);
  check.notNegative("predicted_utime", m.predicted_utime);
  return check.positiveOrZero("f_normal", m.f_normal)
      .positiveOrZero("grip_force", m.grip_force)
      .finite("p_HBall", m.p_HBall)
      .positiveOrZero("youngs_modulus", m.youngs_modulus)
      .positiveOrZero("dead_time", m.dead_time)
      .fault();
}

}  // namespace fastball::messaging
