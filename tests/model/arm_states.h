#pragma once

#include <random>
#include <string>
#include <vector>

#include "config/experiment.h"
#include "model/arm.h"

namespace fastball::model {

/// The project's own experiment.
inline const config::Experiment& defaultExperiment() {
  static const config::Experiment experiment =
      config::loadExperiment(FASTBALL_SOURCE_DIR "/config/experiment.yaml");
  return experiment;
}

/// The default arm with hand and ball on its tool plate.
inline Arm loadedArm() {
  return Arm(defaultExperiment().arm, defaultExperiment().hand.payload);
}

struct ArmState {
  Vector4 q, qd, qdd;
};

inline Vector4 randomVector(std::mt19937* random, const Vector4& low, const Vector4& high) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Vector4 value;
  for (int i = 0; i < kArmJoints; ++i) {
    value[i] = low[i] + (high[i] - low[i]) * uniform(*random);
  }
  return value;
}

/// Anywhere between the stops, at speeds up to the limits and accelerations up to 100 rad/s^2.
inline ArmState randomState(std::mt19937* random) {
  const ArmParameters& arm = defaultExperiment().arm;
  const Vector4 most = Vector4::Constant(100);
  return {randomVector(random, arm.q_min, arm.q_max), randomVector(random, -arm.qd_max, arm.qd_max),
          randomVector(random, -most, most)};
}

/// Zero, tiny, at the limits, and 100 random states.
inline std::vector<ArmState> testStates() {
  const ArmParameters& arm = defaultExperiment().arm;
  const Vector4 zero = Vector4::Zero();
  const Vector4 tiny = Vector4::Constant(1e-9);
  std::vector<ArmState> states = {{zero, zero, zero},
                                  {tiny, tiny, tiny},
                                  {arm.q_min, -arm.qd_max, Vector4::Constant(-100)},
                                  {arm.q_max, arm.qd_max, Vector4::Constant(100)},
                                  {arm.q_max, -arm.qd_max, zero}};
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    states.push_back(randomState(&random));
  }
  return states;
}

/// The state `time` [s] later under constant acceleration.
inline ArmState later(const ArmState& state, double time) {
  return {state.q + time * state.qd + 0.5 * time * time * state.qdd, state.qd + time * state.qdd,
          state.qdd};
}

}  // namespace fastball::model
