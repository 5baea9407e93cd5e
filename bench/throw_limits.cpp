#include "bench/throw_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/plan.h"

namespace fastball::bench {
namespace {

using model::kArmJoints;

// [m] above the shoulder centre, up to where the column stands in the way of the ball.
constexpr double kColumnTop = 0.1;
// [rad/s], of the friction from above: the true step is 0.01 wide.
constexpr double kFrictionWidth = 0.03, kFrictionLead = 5 * kFrictionWidth;
constexpr double kFlightSpeed = 10;  // [m/s], scale of the velocity at the target

/// How the speeds, or torques, of four joints enter the eight rows.
using Shares = Eigen::Matrix<double, 8, kArmJoints>;
Shares shares(const Eigen::Vector4d& limit, bool differential) {
  Shares rows = Shares::Zero();
  rows(0, 0) = rows(2, 3) = -1;
  rows(1, 0) = rows(3, 3) = 1;
  if (differential) {
    rows.block<4, 2>(4, 1) << -1, -1, -1, 1, 1, -1, 1, 1;
  } else {
    rows.block<4, 2>(4, 1) << -1, 0, 1, 0, 0, -1, 0, 1;
  }
  return rows * limit.cwiseInverse().asDiagonal();
}

/// Friction from above, for torque in the direction in which the joint's speed is u, with its slope.
struct FrictionBound {
  double value, slope;
};
FrictionBound frictionBound(const model::ArmParameters& arm, int joint, double u) {
  const double step = std::tanh((u + kFrictionLead) / kFrictionWidth);
  const double viscous = arm.viscous_friction[joint], coulomb = arm.coulomb_friction[joint];
  return {viscous * u + coulomb * step, viscous + coulomb * (1 - step * step) / kFrictionWidth};
}

/// Point of the column's axis nearest to the ball, as the vector from there to the ball.
Eigen::Vector3d fromColumn(const Eigen::Vector3d& p_WBall) {
  return {p_WBall.x(), p_WBall.y(), std::max(0.0, p_WBall.z() - kColumnTop)};
}

void fill(const FreeThrow& task,
          const model::ArmMotion& motion,
          const Eigen::Vector4d& tau,
          const Eigen::Vector3d& p_WBall,
          LimitRows& rows) {
  const model::ArmParameters& limits = task.arm->parameters();
  for (int j = 0; j < kArmJoints; ++j) {
    rows.value[LimitRows::kRange + 2 * j] = limits.q_min[j] + limits.position_margin - motion.q[j];
    rows.value[LimitRows::kRange + 2 * j + 1] =
        motion.q[j] - limits.q_max[j] + limits.position_margin;
  }
  rows.value.segment<8>(LimitRows::kSpeed) =
      (shares(task.speed_share * limits.qd_max, limits.differential) * motion.qd).array() - 1;
  rows.value.segment<8>(LimitRows::kTorque) =
      (shares(task.torque_share * limits.tau_max, limits.differential) * tau).array() - 1;
  rows.value[LimitRows::kColumn] = task.body_clearance - fromColumn(p_WBall).norm();
  rows.value[LimitRows::kFloor] = task.lowest_ball - p_WBall.z();
}

}  // namespace

std::string limitName(int row, bool differential) {
  if (row == LimitRows::kColumn)
    return "clearance from the column";
  if (row == LimitRows::kFloor)
    return "clearance from the floor";
  if (row < LimitRows::kSpeed)
    return fmt::format("range of joint {}", row / 2 + 1);
  const int within = (row - LimitRows::kSpeed) % 8 / 2;
  static constexpr std::array<const char*, 4> kOwn = {"joint 1", "joint 4", "joint 2", "joint 3"};
  return fmt::format("{} of {}", row < LimitRows::kTorque ? "speed" : "torque",
                     differential && within >= 2 ? "joints 2 and 3" : kOwn[within]);
}

LimitRows limitRows(const FreeThrow& task, const model::ArmMotion& motion) {
  const model::Arm& arm = *task.arm;
  LimitRows rows;
  fill(task, motion,
       arm.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm.frictionTorque(motion.qd),
       arm.p_WPoint(motion.q, task.p_TBall), rows);
  return rows;
}

LimitSlopes limitSlopes(const FreeThrow& task, const model::ArmMotion& motion) {
  const model::Arm& arm = *task.arm;
  const model::ArmParameters& limits = arm.parameters();
  const model::TorqueDerivatives torque =
      arm.inverseDynamicsDerivatives(motion.q, motion.qd, motion.qdd);
  const model::PointMotion ball = arm.pointMotion(motion.q, motion.qd, motion.qdd, task.p_TBall);
  LimitSlopes slopes;
  fill(task, motion, torque.tau, ball.p, slopes.rows);
  slopes.by_q.setZero();
  slopes.by_qd.setZero();
  slopes.by_qdd.setZero();
  for (int j = 0; j < kArmJoints; ++j) {
    slopes.by_q(LimitRows::kRange + 2 * j, j) = -1;
    slopes.by_q(LimitRows::kRange + 2 * j + 1, j) = 1;
  }
  slopes.by_qd.middleRows<8>(LimitRows::kSpeed) =
      shares(task.speed_share * limits.qd_max, limits.differential);
  const Shares share = shares(task.torque_share * limits.tau_max, limits.differential);
  slopes.by_q.middleRows<8>(LimitRows::kTorque) = share * torque.dtau_dq;
  slopes.by_qd.middleRows<8>(LimitRows::kTorque) = share * torque.dtau_dqd;
  slopes.by_qdd.middleRows<8>(LimitRows::kTorque) = share * torque.dtau_dqdd;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < kArmJoints; ++j) {
      if (share(i, j) == 0 || (j == 1 && task.hold_shoulder))
        continue;
      const double sign = std::copysign(1.0, share(i, j));
      const FrictionBound friction = frictionBound(limits, j, sign * motion.qd[j]);
      slopes.rows.value[LimitRows::kTorque + i] += std::abs(share(i, j)) * friction.value;
      slopes.by_qd(LimitRows::kTorque + i, j) += share(i, j) * friction.slope;
    }
  }
  // At the axis itself every direction leads away from it: none is taken.
  slopes.by_q.row(LimitRows::kColumn) = -fromColumn(ball.p).stableNormalized().transpose() * ball.J;
  slopes.by_q.row(LimitRows::kFloor) = -ball.J.row(2);
  return slopes;
}

ReleaseRows releaseRows(const FreeThrow& task,
                        const Eigen::Vector4d& q,
                        const Eigen::Vector4d& qd,
                        double flight_time) {
  const model::PointMotion point =
      task.arm->pointMotion(q, qd, Eigen::Vector4d::Zero(), task.p_TBall);
  Eigen::Matrix<double, 3, ReleaseRows::kBy> dp, dv;
  dp << point.J, Eigen::Matrix<double, 3, kArmJoints + 1>::Zero();
  dv << point.dv_dq, point.J, Eigen::Vector3d::Zero();
  ReleaseRows rows;
  rows.ball = {point.p, point.v};
  rows.speed = point.v.norm();
  rows.speed_slope = point.v.stableNormalized().transpose() * dv;
  rows.equal_slope.setZero();
  rows.grazing_slope.setZero();
  if (task.across_forearm) {
    const model::DirectionMotion forearm = task.arm->toolAxis(q);
    rows.equal[3] = forearm.e.dot(point.v);
    rows.equal_slope.row(3) = forearm.e.transpose() * dv;
    rows.equal_slope.block<1, kArmJoints>(3, 0) += point.v.transpose() * forearm.de_dq;
  }
  if (!task.target)
    return rows;
  const double gravity = task.arm->parameters().gravity;
  const model::FlightDerivatives end =
      model::flyWithDerivatives(rows.ball, flight_time, task.drag_per_metre, gravity);
  rows.equal.head<3>() = end.state.p_WBall - task.target->p_WTarget;
  rows.equal_slope.topRows<3>() = dp + end.dp_dv * dv;
  rows.equal_slope.topRightCorner<3, 1>() = end.state.v_WBall;
  const Eigen::Vector3d& v = end.state.v_WBall;
  const Eigen::RowVector3d n = task.target->n_WTarget.transpose(),
                           by_v =
                               (n + planner::kLeastSteepness * v.stableNormalized().transpose()) /
                               kFlightSpeed;
  rows.grazing = (n * v + planner::kLeastSteepness * v.norm()) / kFlightSpeed;
  rows.grazing_slope = by_v * end.dv_dv * dv;
  rows.grazing_slope[ReleaseRows::kBy - 1] =
      by_v * model::flightAcceleration(end.state.v_WBall, task.drag_per_metre, gravity);
  return rows;
}

EqualRows equalRows(const FreeThrow& task) {
  const int landing = task.target ? 3 : 0;
  return {3 - landing, landing + (task.across_forearm ? 1 : 0)};
}

}  // namespace fastball::bench
