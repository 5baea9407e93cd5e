#pragma once

#include "config/experiment.h"
#include "model/swing_model.h"

namespace fastball::model {

/// The two links of the swing model that the WAM with its hand and ball makes.
inline SwingParameters wamParameters() {
  static const config::Experiment experiment =
      config::loadExperiment(FASTBALL_SOURCE_DIR "/config/experiment.yaml");
  return swingParameters(experiment.arm, experiment.hand.payload, experiment.hand.p_HBall);
}

/// Of either swing model: [rad], [rad/s].
struct State {
  Eigen::Vector3d q, qd;
};

}  // namespace fastball::model
