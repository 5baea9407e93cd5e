#include "planner/release_prediction.h"

#include <algorithm>
#include <cmath>

#include "planner/hand_motion.h"

namespace fastball::planner {
namespace {

constexpr double kEarliest = -0.02,
                 kLatest = 0.02;  // [s], about t = 0, in which Eq. (24) comes true
constexpr double kStep = 1e-4;    // [s]
// [s] after it has left, nothing of the hand touches the ball
constexpr double kClearTime = 0.15;

}  // namespace

PredictDeparture elasticDeparture(const PlannerConfig& config) {
  const model::Hand hand(config.hand);
  model::ReleaseCommand command;
  command.grip_force = config.grip_force;
  command.settings = config.release;
  return [ball = config.ball, hand, command, gravity = config.arm.gravity](
             const std::function<model::HandMotion(double)>& hand_at,
             const model::HandSupport& support, model::ReleaseMode mode) {
    model::ReleaseCommand in_mode = command;
    in_mode.mode = mode;
    constexpr double kTimeStep = 1e-4, kMaxTime = 0.1;  // [s]
    return model::predictDeparture(ball, hand, in_mode, hand_at, gravity, &support, kTimeStep,
                                   kMaxTime, kClearTime);
  };
}

PredictDeparture instantDeparture(const PlannerConfig& config) {
  return [p_HBall = config.hand.p_HBall](const std::function<model::HandMotion(double)>& hand_at,
                                         const model::HandSupport& /*support*/,
                                         model::ReleaseMode /*mode*/) {
    const model::HandMotion hand = hand_at(0);
    const Eigen::Vector3d arm_W = hand.X_WH.linear() * p_HBall;
    model::Departure departure;
    departure.departed = true;
    departure.ball.p_WBall = hand.X_WH.translation() + arm_W;
    departure.ball.v_WBall = hand.v_WH + hand.w_WH.cross(arm_W);
    departure.w_WBall = hand.w_WH;
    return departure;
  };
}

ReleasePredictor::ReleasePredictor(const PlannerConfig& config,
                                   const model::Arm& arm,
                                   PredictDeparture departure)
    : config_(config), arm_(arm), hand_(config.hand), departure_(std::move(departure)) {}

WristAngles ReleasePredictor::wristAngles(const WholeMotion& motion) const {
  return throwDirection(arm_, hand_, motion.trajectory.at(motion.t_zero)).wrist;
}

std::optional<ReleasePrediction> ReleasePredictor::predict(const WholeMotion& motion,
                                                           const WristAngles& wrist,
                                                           const model::Target& target,
                                                           double t_command) const {
  const model::HandSupport support =
      model::handSupport(arm_, config_.hand, motion.trajectory.at(t_command).q,
                         {wrist.roll, wrist.flexion}, config_.support_kp, config_.support_kd);
  const model::Departure left = departure_(
      [&](double t) { return handMotion(arm_, hand_, wrist, motion.trajectory.at(t_command + t)); },
      support, config_.release.modeFor(motion.window));
  if (!left.departed || left.time < 0 || left.touched_again >= 0)
    return {};
  const std::optional<model::Landing> landing =
      model::land(left.ball, target, config_.ball.dragPerMetre(), config_.arm.gravity);
  if (!landing)
    return {};
  return ReleasePrediction{t_command, t_command + left.time, wrist, left.ball, *landing};
}

std::optional<ReleasePrediction> ReleasePredictor::predict(const WholeMotion& motion,
                                                           const model::Target& target,
                                                           double t_command) const {
  return predict(motion, wristAngles(motion), target, t_command);
}

double ReleasePredictor::commandTime(const WholeMotion& motion) const {
  const WristAngles wrist = wristAngles(motion);
  const Eigen::Isometry3d X_TH = hand_.X_TH(wrist.roll, wrist.flexion);
  const Eigen::Vector3d p_TBall = X_TH * config_.hand.p_HBall;
  const Eigen::Vector3d y_TH = X_TH.linear().col(1);
  const Eigen::Vector3d g_W(0, 0, -config_.arm.gravity);
  // From the end backwards: the hand must stay slower than the ball afterwards.
  double t = motion.t_zero + kLatest;
  while (t > motion.t_zero + kEarliest) {
    const model::ArmMotion at = motion.trajectory.at(t - kStep);
    const Eigen::Vector3d a_W = arm_.pointAcceleration(at.q, at.qd, at.qdd, p_TBall);
    if ((a_W - g_W).dot(arm_.X_WT(at.q).linear() * y_TH) > 0)
      break;
    t -= kStep;
  }
  const model::ReleaseSettings& release = config_.release;
  const double later = release.delayOf(release.modeFor(motion.window)) -
                       release.delayOf(model::ReleaseMode::kAbrupt);
  return 1e-3 * std::round(1e3 * (t - config_.hand.actuator_lag - later));
}

double ReleasePredictor::windowCommandTime(const WholeMotion& motion) const {
  const double delay = config_.release.delayOf(config_.release.modeFor(motion.window));
  return motion.t_zero + 1e-3 * std::round(1e3 * (motion.window / 2 - delay));
}

double ReleasePredictor::residualAcceleration(const model::SampledTrajectory& trajectory,
                                              const WristAngles& wrist,
                                              double from,
                                              double to) const {
  constexpr int kSteps = 10;
  const Eigen::Vector3d p_TBall = hand_.X_TH(wrist.roll, wrist.flexion) * config_.hand.p_HBall;
  double largest = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const model::ArmMotion motion = trajectory.at(from + (to - from) * k / kSteps);
    const Eigen::Vector3d v_W = arm_.pointJacobian(motion.q, p_TBall) * motion.qd;
    const Eigen::Vector3d a_W = arm_.pointAcceleration(motion.q, motion.qd, motion.qdd, p_TBall);
    const Eigen::Vector3d free =
        model::flightAcceleration(v_W, config_.ball.dragPerMetre(), config_.arm.gravity);
    largest = std::max(largest, (a_W - free).norm());
  }
  return largest;
}

}  // namespace fastball::planner
