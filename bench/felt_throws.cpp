#include "bench/felt_throws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>
#include <vector>

namespace fastball::bench {
namespace {

constexpr double kHold =
    0.55;  // [s], from the scene's start until the swing begins: the hand has tried to open by then
constexpr double kPatience = 0.2;  // [s] after the command, then the ball should be gone
constexpr int64_t kTickUs = 1000;
constexpr int64_t kSceneUs = 10'000'000;  // between the starts of two scenes

hand_server::HandPlan fromSwing(const planner::Plan& plan) {
  const double dt = plan.trajectory.dt();
  const auto first = static_cast<std::ptrdiff_t>(plan.t_swing / dt);
  const double skipped = dt * static_cast<double>(first);
  const auto& samples = plan.trajectory.samples();
  hand_server::HandPlan result;
  result.t_swing = plan.t_swing - skipped;
  result.t_release_command = plan.t_release_command - skipped;
  result.t_release = plan.t_release - skipped;
  result.window = plan.release_window[1] - plan.release_window[0];
  result.grip_force = plan.grip_force;
  result.q_wrist = {plan.wrist_roll, plan.wrist_flexion};
  result.adapts = plan.strategy == "tactile";
  result.arm = model::SampledTrajectory(
      dt, std::vector<model::ArmMotion>(samples.begin() + first, samples.end()));
  return result;
}

hand_server::HandPlan makePlan(const std::string& path,
                               const config::Experiment& experiment,
                               const std::string& strategy) {
  const planner::PlanResult result = planner::Planner(planner::loadConfig(path))
                                         .plan({strategy, experiment.q_rest, experiment.target, 1});
  if (const auto* refusal = std::get_if<planner::Refusal>(&result))
    throw std::runtime_error(fmt::format("no throw to feel: {}", refusal->sentence));
  return fromSwing(std::get<planner::Plan>(result));
}

hand_server::HandSample sampleOf(const sim_bullet::RobotState& robot,
                                 int64_t scene_id,
                                 int64_t tick) {
  hand_server::HandSample sample{kSceneUs * scene_id + kTickUs * tick, scene_id, tick, robot.q.hand,
                                 robot.qd.hand};
  sample.tau = robot.tau_hand;
  for (int i = 0; i < model::kFingers; ++i) {
    sample.force[i] = robot.felt[i].normal;
    sample.tangential[i] = robot.felt[i].tangential;
  }
  return sample;
}

bool feelsBall(const sim_bullet::RobotState& robot, double touch_force) {
  return std::any_of(robot.felt.begin(), robot.felt.end(),
                     [=](const auto& finger) { return finger.normal >= touch_force; });
}

}  // namespace

FeltThrows::FeltThrows(const std::string& experiment_path, const std::string& strategy)
    : experiment_(config::loadExperiment(experiment_path)),
      simulation_(sim_bullet::loadSimulationSettings(experiment_path)),
      hand_config_(hand_server::loadConfig(experiment_path)),
      arm_(experiment_.arm, experiment_.hand.payload),
      fingers_(experiment_.hand),
      plan_(makePlan(experiment_path, experiment_, strategy)),
      start_tick_(std::lround((kHold - plan_.t_swing) / sim_bullet::kTick)),
      X_TH_(fingers_.X_TH(plan_.q_wrist[0], plan_.q_wrist[1])) {}

hand_server::HandController FeltThrows::makeHand() const {
  return {arm_, fingers_, experiment_.ball, hand_config_};
}

FeltThrow FeltThrows::run(hand_server::HandController& hand,
                          const sim_bullet::Uncertainty& uncertainty,
                          int64_t seed) const {
  const int64_t scene_id = hand.scene() + 1;
  hand_server::HandPlan plan = plan_;
  plan.id = scene_id;
  const int64_t start_us = kSceneUs * scene_id + kTickUs * start_tick_;
  if (!hand.offerPlan(plan) || !hand.startThrow({plan.id, scene_id, start_us}))
    throw std::runtime_error(hand.notice());
  sim_bullet::Scene scene(experiment_, simulation_, uncertainty,
                          {{0, seed}, plan.arm.at(0).q, experiment_.target});
  const double t_command =
      sim_bullet::kTick * static_cast<double>(start_tick_) + plan.t_release_command;
  FeltThrow thrown;
  thrown.errors = scene.errors();
  thrown.planned_departure = plan.t_release - plan.t_release_command;
  bool departed = false;
  const auto ticks = std::lround((t_command + kPatience) / sim_bullet::kTick);
  for (long k = 0; k < ticks && !(departed && thrown.felt_departure); ++k) {
    const sim_bullet::RobotState& robot = scene.state();
    const Eigen::Vector3d p_HBall =
        (arm_.X_WT(robot.q.arm) * X_TH_).inverse() * scene.ball().p_WBall;
    if (1e-3 * static_cast<double>(k) < kHold)
      thrown.lay = {robot.forces[model::kThumb].normal, p_HBall, thrown.errors.ball.youngs_modulus};
    const auto told = hand.answer(sampleOf(robot, scene_id, k)).value();
    while (const auto event = hand.takeEvent()) {
      if (event->kind == hand_server::ReleaseEvent::Kind::kDeparted)
        thrown.felt_departure =
            1e-6 * static_cast<double>(event->utime - kSceneUs * scene_id) - t_command;
      thrown.felt_lay = event->grip;
      thrown.felt_dead_times = event->dead_times;
      thrown.predicted_departure =
          1e-6 * static_cast<double>(event->predicted_utime - kSceneUs * scene_id) - t_command;
    }
    const double t = sim_bullet::kTick * static_cast<double>(k - start_tick_);
    if (feelsBall(robot, hand_config_.release.touch_force))
      thrown.last_touch = t - plan.t_release_command;
    scene.advance(armTorque(robot, t), {told.q, told.qd, told.tau, told.kp, told.kd});
    for (const sim_bullet::SceneEvent& event : scene.events()) {
      if (event.kind != sim_bullet::SceneEvent::Kind::kReleased)
        continue;
      thrown.departure = event.time - t_command;
      departed = true;
    }
  }
  if (!departed)
    throw std::runtime_error(fmt::format(
        "the ball has not left the hand {} s after the command, seed {}", kPatience, seed));
  return thrown;
}

/// Feed-forward with the controller's feedback.
Eigen::Vector4d FeltThrows::armTorque(const sim_bullet::RobotState& robot, double t) const {
  const Eigen::Vector4d kp(8000, 8000, 2000, 5000), kd(250, 250, 22, 70);
  const model::ArmMotion motion = plan_.arm.at(t);
  return arm_.inverseDynamics(motion.q, motion.qd, motion.qdd) + arm_.frictionTorque(motion.qd) +
         kp.cwiseProduct(motion.q - robot.q_arm) + kd.cwiseProduct(motion.qd - robot.qd_arm);
}

sim_bullet::Uncertainty unknownBall() {
  sim_bullet::Uncertainty uncertainty;
  const auto part = sim_bullet::Uncertainty::kThrow;
  uncertainty.setNormal(part, sim_bullet::Error::kGraspOffset, 0.003);
  uncertainty.setNormal(part, sim_bullet::Error::kBallMass, 0.05);
  uncertainty.setUniform(part, sim_bullet::Error::kFriction, -0.375, 0.25);
  uncertainty.of(part, sim_bullet::Error::kStiffness).distribution = {
      sim_bullet::Distribution::Shape::kLogUniform, 0.4, 2};
  return uncertainty;
}

DepartureError departureError(const FeltThrows& throws,
                              const sim_bullet::Uncertainty& uncertainty,
                              int count) {
  DepartureError error;
  hand_server::HandController hand = throws.makeHand();
  for (int seed = 1; seed <= count; ++seed) {
    const FeltThrow thrown = throws.run(hand, uncertainty, seed);
    error.missed += !thrown.felt_departure;
    error.felt += std::pow(thrown.felt_departure.value_or(0) - thrown.departure, 2) / count;
    error.last_touch += std::pow(thrown.last_touch - thrown.departure, 2) / count;
  }
  error.felt = std::sqrt(error.felt);
  error.last_touch = std::sqrt(error.last_touch);
  return error;
}

}  // namespace fastball::bench
