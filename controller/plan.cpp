#include "controller/plan.h"

#include <fmt/format.h>

#include <cmath>

namespace fastball::controller {
namespace {

/// Limits may be exceeded by this share: a planner that works up to a limit must not fail by rounding.
constexpr double kRounding = 1e-6;
/// Speed [rad/s] that counts as rest at the ends of a plan.
constexpr double kRest = 1e-6;

std::optional<std::string> timesFault(const Plan& plan) {
  const double duration = plan.trajectory.duration();
  if (!(0 <= plan.t_ready && plan.t_ready <= plan.t_swing && plan.t_swing <= plan.t_swing_end &&
        plan.t_swing_end <= duration)) {
    return fmt::format(
        "plan {}: its times are out of order (ready {:.4g} s, swing {:.4g} s, swing end {:.4g} s, "
        "end "
        "{:.4g} s)",
        plan.id, plan.t_ready, plan.t_swing, plan.t_swing_end, duration);
  }
  return {};
}

std::optional<std::string> samplesFault(const Plan& plan) {
  const auto& samples = plan.trajectory.samples();
  if (samples.size() < 2) {
    return fmt::format("plan {}: it has {} samples, at least 2 are needed", plan.id,
                       samples.size());
  }
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!samples[k].q.allFinite() || !samples[k].qd.allFinite() || !samples[k].qdd.allFinite()) {
      return fmt::format("plan {}: sample {} is not finite", plan.id, k);
    }
  }
  const auto atRest = [](const model::ArmMotion& m) { return m.qd.cwiseAbs().maxCoeff() <= kRest; };
  if (!atRest(samples.front()) || !atRest(samples.back())) {
    const bool first = !atRest(samples.front());
    const Eigen::Vector4d& qd = first ? samples.front().qd : samples.back().qd;
    int joint = 0;
    qd.cwiseAbs().maxCoeff(&joint);
    return fmt::format(
        "plan {}: joint {} moves at {:.4g} rad/s in the {} sample, where the arm must rest",
        plan.id, joint + 1, qd[joint], first ? "first" : "last");
  }
  return {};
}

std::optional<std::string> positionFault(const model::ArmParameters& arm,
                                         const Plan& plan,
                                         const Eigen::Vector4d& q,
                                         double t) {
  for (int i = 0; i < model::kArmJoints; ++i) {
    const double low = arm.q_min[i] + arm.position_margin;
    const double high = arm.q_max[i] - arm.position_margin;
    if (q[i] < low - kRounding || q[i] > high + kRounding) {
      return fmt::format(
          "plan {}: joint {} is at {:.4g} rad at t = {:.3f} s, its limits with margin are {:.4g} "
          "to {:.4g} "
          "rad ({})",
          plan.id, i + 1, q[i], t, low, high, arm.profile);
    }
  }
  return {};
}

/// The sentence for a speed or torque over its limit: the joint that is over alone, or else the pair that shares two motors.
std::string overLimit(const model::ArmParameters& arm,
                      const Plan& plan,
                      const char* what,
                      const char* unit,
                      const Eigen::Vector4d& value,
                      const Eigen::Vector4d& limit,
                      double t) {
  int joint = 0;
  const double alone = value.cwiseAbs().cwiseQuotient(limit).maxCoeff(&joint);
  if (alone > 1 + kRounding) {
    return fmt::format(
        "plan {}: joint {} has a {} of {:.4g} {} at t = {:.3f} s, its limit is {:.4g} {} ({})",
        plan.id, joint + 1, what, value[joint], unit, t, limit[joint], unit, arm.profile);
  }
  return fmt::format(
      "plan {}: joints 2 and 3 have a {} of {:.4g} and {:.4g} {} at t = {:.3f} s, together {:.3f} "
      "of what "
      "their shared motors can do ({})",
      plan.id, what, value[1], value[2], unit, t,
      std::abs(value[1]) / limit[1] + std::abs(value[2]) / limit[2], arm.profile);
}

std::optional<std::string> limitFault(const model::Arm& arm, const Plan& plan) {
  const model::ArmParameters& limits = arm.parameters();
  const int ticks = static_cast<int>(std::ceil(plan.trajectory.duration() * 1000 - 1e-9));
  for (int k = 0; k <= ticks; ++k) {
    const double t = k * 1e-3;
    const model::ArmMotion motion = plan.trajectory.at(t);
    if (auto fault = positionFault(limits, plan, motion.q, t)) {
      return fault;
    }
    if (arm.speedRatio(motion.qd) > 1 + kRounding) {
      return overLimit(limits, plan, "speed", "rad/s", motion.qd, limits.qd_max, t);
    }
    const Eigen::Vector4d tau =
        arm.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm.frictionTorque(motion.qd);
    if (arm.torqueRatio(tau) > 1 + kRounding) {
      return overLimit(limits, plan, "torque", "N m", tau, limits.tau_max, t);
    }
  }
  return {};
}

}  // namespace

bool operator==(const Plan& a, const Plan& b) {
  return a.id == b.id && a.t_ready == b.t_ready && a.t_swing == b.t_swing &&
         a.t_swing_end == b.t_swing_end && a.t_release == b.t_release &&
         a.flight_time == b.flight_time && a.q_wrist == b.q_wrist && a.trajectory == b.trajectory;
}

std::optional<std::string> planFault(const model::Arm& arm, const Plan& plan) {
  if (auto fault = samplesFault(plan)) {
    return fault;
  }
  if (auto fault = timesFault(plan)) {
    return fault;
  }
  return limitFault(arm, plan);
}

std::optional<std::string> startFault(const Plan& plan,
                                      const Eigen::Vector4d& q,
                                      double tolerance) {
  const Eigen::Vector4d& start = plan.trajectory.samples().front().q;
  int joint = 0;
  const double distance = (start - q).cwiseAbs().maxCoeff(&joint);
  if (distance <= tolerance) {
    return {};
  }
  return fmt::format(
      "plan {}: joint {} starts at {:.4g} rad, but the arm is at {:.4g} rad; at most {:.4g} rad "
      "apart is "
      "allowed",
      plan.id, joint + 1, start[joint], q[joint], tolerance);
}

}  // namespace fastball::controller
