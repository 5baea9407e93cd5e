#pragma once

#include <string>

#include "config/experiment.h"
#include "planner/planner.h"

namespace fastball::planner {

/// The default experiment, and what its experiment process would ask the planner for.
struct DefaultThrow {
  std::string path = FASTBALL_SOURCE_DIR "/config/experiment.yaml";
  config::Experiment experiment = config::loadExperiment(path);
  PlannerConfig config = loadConfig(path);

  ThrowRequest request() const { return {"paper", experiment.q_rest, experiment.target, 1}; }
  /// The same for a net elsewhere, facing the robot.
  ThrowRequest requestTo(double x, double y, double z, int64_t seed = 1) const {
    ThrowRequest result = request();
    result.target.p_WTarget = {x, y, z};
    result.target.n_WTarget = -Eigen::Vector3d(x, y, 0).normalized();
    result.seed = seed;
    return result;
  }
};

}  // namespace fastball::planner
