#include "launch/throw_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace fastball::launch {
namespace {

constexpr double kMicro = 1e6;

template <class Message>
void setTarget(Message& message, const model::Target& target) {
  Eigen::Map<Eigen::Vector3d>(message.p_WTarget) = target.p_WTarget;
  Eigen::Map<Eigen::Vector3d>(message.n_WTarget) = target.n_WTarget;
  message.target_radius = target.radius;
}

}  // namespace

int64_t throwSeed(int64_t seed, int throw_number) {
  const auto bits = static_cast<uint64_t>(seed);
  std::seed_seq sequence{static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32),
                         static_cast<uint32_t>(throw_number)};
  return static_cast<int64_t>(std::mt19937_64(sequence)() >> 1);
}

int64_t messageNumber(const RunSettings& settings, int throw_number) {
  return settings.throws_before + throw_number;
}

int64_t sceneUtime(const RunSettings& settings, int throw_number) {
  return messageNumber(settings, throw_number) *
         std::llround(settings.config.scene_period * kMicro);
}

plan_request_t planRequest(const RunSettings& settings, int throw_number) {
  plan_request_t request{};
  request.request_id = messageNumber(settings, throw_number);
  request.seed = throwSeed(settings.seed, throw_number);
  request.strategy = settings.strategy;
  Eigen::Map<Eigen::Vector4d>(request.q_arm) = settings.q_rest;
  setTarget(request, settings.target);
  return request;
}

throw_start_t throwStart(const RunSettings& settings, int throw_number) {
  throw_start_t start{};
  start.plan_id = messageNumber(settings, throw_number);
  start.scene_id = messageNumber(settings, throw_number);
  start.start_utime =
      sceneUtime(settings, throw_number) + std::llround(settings.config.settle * kMicro);
  return start;
}

scene_t scene(const RunSettings& settings, int throw_number, const swing_plan_t& plan) {
  const RunConfig& run = settings.config;
  const double plan_duration = (plan.n_samples - 1) * plan.dt;
  const double t_landing = plan.t_release + plan.flight_time;
  scene_t scene{};
  scene.utime = sceneUtime(settings, throw_number);
  scene.scene_id = messageNumber(settings, throw_number);
  scene.seed = throwSeed(settings.seed, throw_number);
  scene.set_up_seed = settings.seed;
  Eigen::Map<Eigen::Vector4d>(scene.q_arm) = settings.q_rest;
  scene.duration = run.settle + std::max(plan_duration, t_landing + run.scene_tail);
  scene.camera_start = std::max(0.0, run.settle + plan.t_swing - run.camera_lead);
  scene.camera_end = run.settle + t_landing + run.camera_tail;
  setTarget(scene, settings.target);
  if (scene.duration > run.scene_period) {
    throw std::runtime_error(fmt::format(
        "throw {} takes {:.3f} s, longer than the {:.3f} s between two scenes (run.scene_period)",
        throw_number, scene.duration, run.scene_period));
  }
  return scene;
}

}  // namespace fastball::launch
