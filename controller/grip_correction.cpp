#include "controller/grip_correction.h"

#include <Eigen/LU>

#include "model/arm_derivatives.h"
#include "model/ball_flight.h"

namespace fastball::controller {
namespace {

/// Two directions, as rows, across v.
Eigen::Matrix<double, 2, 3> across(const Eigen::Vector3d& v) {
  const Eigen::Vector3d side = v.unitOrthogonal();
  Eigen::Matrix<double, 2, 3> rows;
  rows << side.transpose(), v.normalized().cross(side).transpose();
  return rows;
}

}  // namespace

Eigen::Vector4d GripCorrection::postureChange(const Plan& plan,
                                              const Eigen::Vector3d& p_HBall) const {
  const model::ArmMotion motion = plan.trajectory.at(plan.t_release);
  const Eigen::Isometry3d X_TH = hand_.X_TH(plan.q_wrist[0], plan.q_wrist[1]);
  const Eigen::Vector3d& p_HPlanned = hand_.parameters().p_HBall;
  const Eigen::Vector3d offset_T = X_TH.linear() * (p_HBall - p_HPlanned);
  const model::PointMotion ball =
      arm_.pointMotion(motion.q, motion.qd, motion.qdd, X_TH * p_HPlanned);
  const Eigen::Vector3d dp = arm_.X_WT(motion.q).linear() * offset_T;
  const Eigen::Vector3d dv = (arm_.rotationJacobian(motion.q) * motion.qd).cross(dp);

  const model::FlightDerivatives flight = model::flyWithDerivatives(
      {ball.p, ball.v}, plan.flight_time, ball_.dragPerMetre(), arm_.parameters().gravity);
  const Eigen::Matrix<double, 2, 3> sideways = across(flight.state.v_WBall);
  const Eigen::Matrix<double, 2, 4> by_posture = sideways * (ball.J + flight.dp_dv * ball.dv_dq);
  const Eigen::Vector2d by_offset = sideways * (dp + flight.dp_dv * dv);
  const Eigen::Matrix2d gram = by_posture * by_posture.transpose();
  return -by_posture.transpose() * (gram.inverse() * by_offset);
}

}  // namespace fastball::controller
