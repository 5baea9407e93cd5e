#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "launch/run_config.h"
#include "messaging/channels.h"
#include "model/ball_parameters.h"
#include "model/target.h"

namespace fastball::launch {

/// What all throws of a run have in common.
struct RunSettings {
  int throws = 1;
  int64_t seed = 1;
  int64_t throws_before =
      0;  ///< that the processes have made for earlier runs; numbers go on from there
  std::string strategy;
  Eigen::Vector4d q_rest = Eigen::Vector4d::Zero();  ///< [rad], where the arm rests before a throw
  model::Target target;
  RunConfig config;
  std::string learned;  ///< file of strategy adaptive; empty: it begins anew
  model::BallParameters ball;
  double gravity = 9.81;  ///< [m/s^2]
  bool images = true;     ///< false: the simulator says LANDING in the tracker's place
};

/// Seed of throw k = 1, 2, ... of a run: never negative, and unlike that of any other throw or run
/// but for chance.
int64_t throwSeed(int64_t seed, int throw_number);

/// Number of throw k = 1, 2, ... in the messages: request, plan and scene.
int64_t messageNumber(const RunSettings& settings, int throw_number);

/// Simulated time [us] at which the scene of throw k begins.
int64_t sceneUtime(const RunSettings& settings, int throw_number);

/// The three orders that make throw k. `plan`: the planner's answer, status OK.
plan_request_t planRequest(const RunSettings& settings, int throw_number);
throw_start_t throwStart(const RunSettings& settings, int throw_number);
/// @throw std::runtime_error if the throw takes longer than the time between two scenes.
scene_t scene(const RunSettings& settings, int throw_number, const swing_plan_t& plan);

}  // namespace fastball::launch
