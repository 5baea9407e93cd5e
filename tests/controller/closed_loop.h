#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "config/experiment.h"
#include "controller/arm_controller.h"
#include "controller/config.h"

namespace fastball::controller {

inline const std::string kExperimentPath = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

inline const config::Experiment& experiment() {
  static const config::Experiment loaded = config::loadExperiment(kExperimentPath);
  return loaded;
}

inline model::Arm testArm() {
  return model::Arm(experiment().arm, experiment().hand.payload);
}

inline ArmController testController() {
  return {testArm(), model::Hand(experiment().hand), experiment().ball,
          loadConfig(kExperimentPath)};
}

/// The arm with its friction, held torque over each tick, integrated at 0.1 ms (semi-implicit Euler).
struct SimulatedArm {
  model::Arm arm = testArm();
  Eigen::Vector4d q = Eigen::Vector4d::Zero();   ///< [rad]
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();  ///< [rad/s]

  void tick(const Eigen::Vector4d& tau) {
    for (int i = 0; i < 10; ++i) {
      qd += 1e-4 * arm.forwardDynamics(q, qd, tau - arm.frictionTorque(qd));
      q += 1e-4 * qd;
    }
  }
};

/// From rest at `from` to rest at `to` by a quintic that takes `duration` [s], sampled every 10 ms.
inline std::vector<model::ArmMotion> quintic(const Eigen::Vector4d& from,
                                             const Eigen::Vector4d& to,
                                             double duration) {
  std::vector<model::ArmMotion> samples;
  const int intervals = static_cast<int>(std::lround(duration * 100));
  for (int k = 0; k <= intervals; ++k) {
    const double s = static_cast<double>(k) / intervals, s2 = s * s;
    const Eigen::Vector4d way = to - from;
    samples.push_back({from + way * (s2 * s * (10 - 15 * s + 6 * s2)),
                       way * (30 * s2 * (1 - 2 * s + s2) / duration),
                       way * (60 * s * (1 - 3 * s + 2 * s2) / (duration * duration))});
  }
  return samples;
}

inline const Eigen::Vector4d kBack{-0.6, 1.3, 0.0, 1.9};  ///< [rad], where the swing below begins
inline const Eigen::Vector4d kFront{0.4, 1.2, 0.9, 0.5};  ///< [rad], where it ends

/// Rests for `t_swing` [s], swings at almost full speed from kBack to kFront in 0.8 s, and rests 0.1 s.
inline Plan swingPlan(int64_t id = 1, double t_swing = 0.1) {
  std::vector<model::ArmMotion> samples(static_cast<std::size_t>(std::lround(100 * t_swing)),
                                        model::ArmMotion{kBack});
  const auto swing = quintic(kBack, kFront, 0.8);
  samples.insert(samples.end(), swing.begin(), swing.end());
  samples.resize(samples.size() + 10, model::ArmMotion{kFront});
  return {id,
          t_swing / 2,
          t_swing,
          t_swing + 0.8,
          model::SampledTrajectory(0.01, std::move(samples)),
          t_swing + 0.5,
          0.6,
          {0.1, -0.2}};
}

}  // namespace fastball::controller
