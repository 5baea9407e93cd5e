#include "planner/limit_check.h"

#include <fmt/format.h>

#include <cmath>

namespace fastball::planner {
namespace {

constexpr double kStep = 1e-3;      // [s]
constexpr double kRounding = 1e-9;  // of a limit: the first sample may lie on it

/// The largest value of one kind over a trajectory, and where it was.
struct Worst {
  double value = -1e300;
  double time = 0;
  Eigen::Vector4d at = Eigen::Vector4d::Zero();
  void look(double candidate, double t, const Eigen::Vector4d& vector) {
    if (candidate <= value)
      return;
    value = candidate;
    time = t;
    at = vector;
  }
};

/// "joint 3 turns at 6.1 rad/s 1.2 s after the start, its limit is 5.96 rad/s".
std::string overLimit(const Worst& worst,
                      const Eigen::Vector4d& limit,
                      const char* verb,
                      const char* unit) {
  int joint = 0;
  const double alone = worst.at.cwiseAbs().cwiseQuotient(limit).maxCoeff(&joint);
  if (alone > 1) {
    return fmt::format("joint {} {} {:.4g} {} at {:.3f} s, its limit is {:.4g} {}", joint + 1, verb,
                       worst.at[joint], unit, worst.time, limit[joint], unit);
  }
  return fmt::format(
      "joints 2 and 3 {} {:.4g} and {:.4g} {} at {:.3f} s, which is {:.3g} times what their "
      "differential allows",
      verb, worst.at[1], worst.at[2], unit, worst.time, worst.value);
}

std::string outOfRange(const Worst& worst, const model::ArmParameters& limits) {
  int joint = 0;
  const Eigen::Vector4d low = limits.q_min - worst.at, high = worst.at - limits.q_max;
  low.cwiseMax(high).maxCoeff(&joint);
  return fmt::format(
      "joint {} is at {:.4g} rad at {:.3f} s, its range is {:.4g} to {:.4g} rad less a margin of "
      "{:.3g} rad",
      joint + 1, worst.at[joint], worst.time, limits.q_min[joint], limits.q_max[joint],
      limits.position_margin);
}

}  // namespace

LimitUse checkLimits(const model::Arm& arm, const model::SampledTrajectory& trajectory) {
  const model::ArmParameters& limits = arm.parameters();
  Worst position, speed, torque;
  const int steps = static_cast<int>(std::ceil(trajectory.duration() / kStep));
  for (int k = 0; k <= steps; ++k) {
    const double t = k * kStep;
    const model::ArmMotion motion = trajectory.at(t);
    const double excess = (limits.q_min - motion.q).cwiseMax(motion.q - limits.q_max).maxCoeff() +
                          limits.position_margin;
    position.look(excess, t, motion.q);
    speed.look(arm.speedRatio(motion.qd), t, motion.qd);
    const Eigen::Vector4d tau =
        arm.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm.frictionTorque(motion.qd);
    torque.look(arm.torqueRatio(tau), t, tau);
  }
  LimitUse use{-position.value, speed.value, torque.value, {}};
  if (position.value > kRounding) {
    use.violation = outOfRange(position, limits);
  } else if (speed.value > 1 + kRounding) {
    use.violation = overLimit(speed, limits.qd_max, "would have to turn at", "rad/s");
  } else if (torque.value > 1 + kRounding) {
    use.violation = overLimit(torque, limits.tau_max, "would need", "N m");
  }
  return use;
}

}  // namespace fastball::planner
