#include "planner/hand_departure.h"

namespace fastball::planner {
namespace {

/// The grasped ball's nominal place, and the axes of H.
struct NominalBall {
  model::BallState ball;
  Eigen::Matrix3d R_WH;
};

NominalBall nominalBall(const PlannerConfig& config,
                        const model::Arm& arm,
                        const WristAngles& wrist,
                        const model::ArmMotion& motion) {
  const Eigen::Isometry3d X_TH = model::Hand(config.hand).X_TH(wrist.roll, wrist.flexion);
  const Eigen::Vector3d p_TBall = X_TH * config.hand.p_HBall;
  const Eigen::Isometry3d X_WT = arm.X_WT(motion.q);
  return {{X_WT * p_TBall, arm.pointJacobian(motion.q, p_TBall) * motion.qd},
          X_WT.linear() * X_TH.linear()};
}

}  // namespace

HandDeparture seenFromHand(const PlannerConfig& config,
                           const model::Arm& arm,
                           const WholeMotion& motion,
                           const ReleasePrediction& prediction) {
  const double t = prediction.t_command + HandDeparture::kTime;
  const model::BallState ball = model::fly(prediction.ball, t - prediction.t_departure,
                                           config.ball.dragPerMetre(), config.arm.gravity);
  const NominalBall nominal = nominalBall(config, arm, prediction.wrist, motion.trajectory.at(t));
  HandDeparture departure;
  departure.delay = prediction.t_departure - prediction.t_command;
  departure.p_H = nominal.R_WH.transpose() * (ball.p_WBall - nominal.ball.p_WBall);
  departure.v_H = nominal.R_WH.transpose() * (ball.v_WBall - nominal.ball.v_WBall);
  return departure;
}

std::optional<ReleasePrediction> predictByDeparture(const PlannerConfig& config,
                                                    const model::Arm& arm,
                                                    const HandDeparture& departure,
                                                    const WholeMotion& motion,
                                                    const WristAngles& wrist,
                                                    const model::Target& target,
                                                    double t_command) {
  const double drag = config.ball.dragPerMetre(), gravity = config.arm.gravity;
  const NominalBall nominal =
      nominalBall(config, arm, wrist, motion.trajectory.at(t_command + HandDeparture::kTime));
  const model::BallState at_time{nominal.ball.p_WBall + nominal.R_WH * departure.p_H,
                                 nominal.ball.v_WBall + nominal.R_WH * departure.v_H};
  const model::BallState left =
      model::fly(at_time, departure.delay - HandDeparture::kTime, drag, gravity);
  const std::optional<model::Landing> landing = model::land(left, target, drag, gravity);
  if (!landing)
    return {};
  return ReleasePrediction{t_command, t_command + departure.delay, wrist, left, *landing};
}

}  // namespace fastball::planner
