#pragma once

#include <string>
#include <utility>
#include <vector>

#include "config/experiment.h"
#include "hand_server/config.h"
#include "hand_server/hand_controller.h"

namespace fastball::hand_server {

inline const std::string kExperimentPath = FASTBALL_SOURCE_DIR "/config/experiment.yaml";

inline const config::Experiment& experiment() {
  static const config::Experiment loaded = config::loadExperiment(kExperimentPath);
  return loaded;
}

inline model::Arm testArm() {
  return model::Arm(experiment().arm, experiment().hand.payload);
}

inline model::Hand testHand() {
  return model::Hand(experiment().hand);
}

/// The arm turns joint 1 from 0 by `angle` [rad] and back to rest: a quintic of 0.6 s that begins at 0.2 s, sampled every 10 ms.
inline model::SampledTrajectory turn(double angle) {
  const Eigen::Vector4d start{0, 1.2, 0, 0.8};
  std::vector<model::ArmMotion> samples;
  for (int k = 0; k <= 100; ++k) {
    const double s = std::min(std::max((k - 20) / 60.0, 0.0), 1.0), s2 = s * s;
    const Eigen::Vector4d way = angle * Eigen::Vector4d::Unit(0);
    samples.push_back({start + way * (s2 * s * (10 - 15 * s + 6 * s2)),
                       way * (30 * s2 * (1 - 2 * s + s2) / 0.6),
                       way * (60 * s * (1 - 3 * s + 2 * s2) / 0.36)});
  }
  return {0.01, std::move(samples)};
}

/// Swing from 0.2 s, release commanded at 0.5 s and expected 10 ms later, grip 4 N.
inline HandPlan throwPlan(int64_t id = 1, double window = 0) {
  return {id, 0.2, 0.5, 0.51, window, 4.0, Eigen::Vector2d(0.1, -0.05), turn(1.0)};
}

/// A hand whose joints are where they are told to be; one without stiffness is moved by its torque alone.
struct ScriptedHand {
  model::HandVector q = model::HandVector::Zero();   ///< [rad]
  model::HandVector qd = model::HandVector::Zero();  ///< [rad/s]

  void tick(const HandAnswer& answer) {
    constexpr double kInertia = 6e-4;  // [kg m^2], about that of a whole finger
    for (int i = 0; i < model::kHandJoints; ++i) {
      const bool free = answer.kp[i] == 0;
      qd[i] = free ? qd[i] + 1e-3 * answer.tau[i] / kInertia : answer.qd[i];
      q[i] = free ? q[i] + 1e-3 * qd[i] : answer.q[i];
    }
  }
};

}  // namespace fastball::hand_server
