#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "model/arm.h"
#include "model/ball_flight.h"
#include "planner/planner.h"

namespace fastball::planner {

/// Where the ball crosses the target plane [m], by an integration of our own: small steps, midpoint rule.
inline Eigen::Vector2d landingOf(const model::BallState& release,
                                 const model::Target& target,
                                 double k) {
  constexpr double kStep = 2e-5;
  const Eigen::Vector3d gravity(0, 0, -9.81);
  Eigen::Vector3d p = release.p_WBall, v = release.v_WBall;
  while (target.distance(p) > 0 && p.z() > -20) {
    const Eigen::Vector3d v_middle = v + 0.5 * kStep * (gravity - k * v.norm() * v);
    p += kStep * v_middle;
    v += kStep * (gravity - k * v_middle.norm() * v_middle);
  }
  return target.planeCoordinates(p);
}

/// Looks for what the arm's data sheet does not allow, which is written out here once more.
class LimitLook {
 public:
  explicit LimitLook(const PlannerConfig& config)
      : limits_(config.arm), arm_(config.arm, config.hand.payload) {}

  /// The share of its limit that any speed or torque reaches; infinite where an angle is out of range or anything is no number.
  double share(const model::ArmMotion& at) const {
    const Eigen::Vector4d tau =
        arm_.inverseDynamics(at.q, at.qd, at.qdd) + arm_.frictionTorque(at.qd);
    const Eigen::Array4d speed = at.qd.array().abs() / limits_.qd_max.array();
    const Eigen::Array4d torque = tau.array().abs() / limits_.tau_max.array();
    const Eigen::Array4d low = limits_.q_min.array() + limits_.position_margin - kRounding,
                         high = limits_.q_max.array() - limits_.position_margin + kRounding;
    const bool in_range = (at.q.array() >= low).all() && (at.q.array() <= high).all();
    const double share =
        std::max({speed.maxCoeff(), torque.maxCoeff(), speed[1] + speed[2], torque[1] + torque[2]});
    return in_range && std::isfinite(speed.sum() + torque.sum())
               ? share
               : std::numeric_limits<double>::infinity();
  }
  static bool allowed(double share) { return share <= 1 + kRounding; }

 private:
  static constexpr double kRounding = 1e-6;
  model::ArmParameters limits_;
  model::Arm arm_;
};

/// Where a plan exceeds a limit on the grid of 0.1 ms; empty if nowhere. Milliseconds at whose both ends no limit is near are passed over.
inline std::string limitFault(const PlannerConfig& config, const Plan& plan) {
  constexpr double kNear = 0.8;
  const LimitLook look(config);
  const auto share = [&](double t) { return look.share(plan.trajectory.at(t)); };
  double before = share(0);
  for (int ms = 1; 1e-3 * (ms - 1) < plan.trajectory.duration(); ++ms) {
    const double after = share(1e-3 * ms);
    double worst = std::max(before, after);
    for (int k = 1; k < 10 && worst > kNear; ++k)
      worst = std::max(worst, share(1e-3 * (ms - 1) + 1e-4 * k));
    if (!LimitLook::allowed(worst))
      return fmt::format("at {} s {} of a limit", 1e-3 * ms, worst);
    before = after;
  }
  return {};
}

}  // namespace fastball::planner
