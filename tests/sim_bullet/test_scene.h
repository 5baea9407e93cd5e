#pragma once

#include <random>

#include "config/experiment.h"
#include "model/grasp.h"
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
  return {1, experiment().q_rest, experiment().target};
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

/// The hand command that holds the ball: fingers A and B stiff where the grasp wants them, the thumb by its torque.
inline HandCommand graspCommand(double grip_force) {
  const model::Hand hand(experiment().hand);
  const model::GraspGeometry grasp = model::grasp(experiment().ball, hand, grip_force);
  HandCommand command;
  command.q = grasp.q;
  command.kp.setConstant(40);
  command.kd.setConstant(0.1);
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
    const int proximal = model::Hand::proximalJoint(finger);
    command.tau[proximal] = grasp.fingers[finger].torque[1];
    command.tau[proximal + 1] = grasp.fingers[finger].torque[2];
  }
  return command;
}

}  // namespace fastball::sim_bullet
