#pragma once

#include <random>

#include "bench/held_ball.h"
#include "config/experiment.h"
#include "sim_bullet/config.h"
#include "sim_bullet/scene.h"

/// What the simulator's tests share: the default experiment and commands that hold a ball.
namespace fastball::sim_bullet {

inline const std::string kExperimentFile = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

inline const config::Experiment& experiment() {
  static const config::Experiment loaded = config::loadExperiment(kExperimentFile);
  return loaded;
}

inline const SimulationSettings& simulation() {
  static const SimulationSettings loaded = loadSimulationSettings(kExperimentFile);
  return loaded;
}

inline SceneStart restStart() {
  return {{0, 1}, experiment().q_rest, experiment().target};
}

/// An entry of a vector, uniform in +-most.
template <class Vector>
Vector randomVector(std::mt19937& engine, const Vector& most) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector v = most;
  for (int i = 0; i < v.size(); ++i)
    v[i] *= uniform(engine);
  return v;
}

inline HandCommand graspCommand(double grip_force) {
  return bench::graspCommand(experiment(), grip_force);
}

}  // namespace fastball::sim_bullet
