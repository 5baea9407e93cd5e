#include "planner/limit_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/swing_limits.h"

namespace fastball::planner {
namespace {

// The grids [s]: what is far from all limits is looked at in long steps, what is near to one in the shortest.
constexpr double kLongStep = 0.02, kMiddleStep = 1e-3, kShortStep = 1e-4;
constexpr double kRounding = 1e-9;  // of a limit: the first sample may lie on it
// [rad/s], a joint that is faster at both ends of a step does not turn round in between: its friction does not change sign.
constexpr double kTurning = 0.05;

/// The largest value of one kind over a trajectory, and where it was.
struct Worst {
  double value = -1e300;
  double time = 0;
  Eigen::Vector4d at = Eigen::Vector4d::Zero();
  void look(double candidate, double t, const Eigen::Vector4d& vector) {
    // What is no number is worse than anything.
    if (candidate <= value || std::isnan(value))
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

/// What a trajectory asks of the arm at most.
///
/// Looked at are numbers that are smooth in time and whose sizes must not exceed 1. Between two looks such a number can exceed
/// both by an eighth of its second difference, as far as it is a parabola; here by the whole of it, and only if that stays
/// below 1 nothing in between is looked at.
class Use {
 public:
  Use(const model::Arm& arm, const model::SampledTrajectory& trajectory)
      : arm_(arm),
        trajectory_(trajectory),
        speed_share_(driveShares(arm.parameters().qd_max, arm.parameters().differential)),
        torque_share_(driveShares(arm.parameters().tau_max, arm.parameters().differential)) {
    const model::ArmParameters& limits = arm.parameters();
    friction_share_ = torque_share_.cwiseAbs() * limits.coulomb_friction.asDiagonal();
    q_middle_ = (limits.q_min + limits.q_max) / 2;
    q_room_ = (limits.q_max - limits.q_min) / 2 - Eigen::Vector4d::Constant(limits.position_margin);
  }

  void look() {
    const double duration = trajectory_.duration(), dt = trajectory_.dt();
    const double step = dt * std::max(1.0, std::floor(kLongStep / dt));
    lookBetween(0, duration, static_cast<int>(std::ceil(duration / step - 1e-9)), step);
  }

  Worst position, speed, torque;

 private:
  using Shares = Eigen::Array<double, 12, 1>;
  struct Look {
    double time = 0;
    Shares share;  ///< of joint ranges, drive speeds, drive torques
    Eigen::Vector4d qd;
  };

  Look lookAt(double t) {
    const model::ArmParameters& limits = arm_.parameters();
    const model::ArmMotion motion = trajectory_.at(t);
    const Eigen::Vector4d tau =
        arm_.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm_.frictionTorque(motion.qd);
    position.look((limits.q_min - motion.q).cwiseMax(motion.q - limits.q_max).maxCoeff() +
                      limits.position_margin,
                  t, motion.q);
    speed.look(arm_.speedRatio(motion.qd), t, motion.qd);
    torque.look(arm_.torqueRatio(tau), t, tau);
    Look look;
    look.time = t;
    look.share << (motion.q - q_middle_).cwiseQuotient(q_room_), speed_share_ * motion.qd,
        torque_share_ * tau;
    look.qd = motion.qd;
    return look;
  }

  /// The largest size between two looks with such second differences.
  double bound(const Look& a, const Look& b, const Shares& second_difference) const {
    Shares most = a.share.abs().max(b.share.abs()) + second_difference;
    // The friction of a joint that turns round changes its sign at once.
    for (int j = 0; j < model::kArmJoints; ++j) {
      const bool goes_on =
          std::min(a.qd[j], b.qd[j]) > kTurning || std::max(a.qd[j], b.qd[j]) < -kTurning;
      if (!goes_on)
        most.tail<4>() += 2 * friction_share_.col(j).array();
    }
    return most.maxCoeff();
  }

  void lookBetween(double from, double to, int count, double step) {
    std::vector<Look> looks(count + 1);
    for (int k = 0; k <= count; ++k)
      looks[k] = lookAt(std::min(from + k * step, to));
    if (step <= kShortStep * 1.5)
      return;
    const auto difference = [&](int k) -> Shares {
      k = std::clamp(k, 1, std::max(count - 1, 1));
      return (looks[k - 1].share - 2 * looks[k].share + looks[std::min(k + 1, count)].share).abs();
    };
    for (int k = 0; k < count; ++k) {
      const Look &a = looks[k], &b = looks[k + 1];
      if (bound(a, b, difference(k).max(difference(k + 1))) <= 1)
        continue;
      const double finer = step > trajectory_.dt() * 1.5 ? trajectory_.dt()
                           : step > kMiddleStep * 1.5    ? kMiddleStep
                                                         : kShortStep;
      lookBetween(a.time, b.time, static_cast<int>(std::ceil((b.time - a.time) / finer - 1e-9)),
                  finer);
    }
  }

  const model::Arm& arm_;
  const model::SampledTrajectory& trajectory_;
  Eigen::Matrix4d speed_share_, torque_share_, friction_share_;
  Eigen::Vector4d q_middle_, q_room_;
};

}  // namespace

LimitUse checkLimits(const model::Arm& arm, const model::SampledTrajectory& trajectory) {
  const model::ArmParameters& limits = arm.parameters();
  Use worst(arm, trajectory);
  worst.look();
  LimitUse use{worst.speed.value, worst.torque.value, {}};
  if (!(worst.position.value <= kRounding)) {
    use.violation = outOfRange(worst.position, limits);
  } else if (!(worst.speed.value <= 1 + kRounding)) {
    use.violation = overLimit(worst.speed, limits.qd_max, "would have to turn at", "rad/s");
  } else if (!(worst.torque.value <= 1 + kRounding)) {
    use.violation = overLimit(worst.torque, limits.tau_max, "would need", "N m");
  }
  return use;
}

std::string tightestLimit(const model::Arm& arm, const model::SampledTrajectory& trajectory) {
  const model::ArmParameters& limits = arm.parameters();
  Use worst(arm, trajectory);
  worst.look();
  const bool by_speed = worst.speed.value >= worst.torque.value;
  const Worst& most = by_speed ? worst.speed : worst.torque;
  const Eigen::Vector4d& limit = by_speed ? limits.qd_max : limits.tau_max;
  int joint = 0;
  const double alone = most.at.cwiseAbs().cwiseQuotient(limit).maxCoeff(&joint);
  const char* verb = by_speed ? "turn" : "pull";
  const char* unit = by_speed ? "rad/s" : "N m";
  // Half a per cent below the whole it is the joint itself, not the pair.
  if (alone > most.value - 0.005 || !limits.differential) {
    return fmt::format("joint {} {}s at {:.1f} % of its {:.4g} {}", joint + 1, verb, 100 * alone,
                       limit[joint], unit);
  }
  return fmt::format("joints 2 and 3 {} at {:.1f} % of what their differential allows", verb,
                     100 * most.value);
}

}  // namespace fastball::planner
