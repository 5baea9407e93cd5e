#pragma once

#include <string>

#include "config/experiment.h"
#include "sim_bullet/camera_config.h"
#include "vision_tracker/config.h"

namespace fastball::bench {

/// The default experiment as the vision rows take it. @throw config::ConfigError
struct VisionSetup {
  std::string path = config::defaultExperimentPath();
  config::Experiment experiment = config::loadExperiment(path);
  vision_tracker::TrackerOptions tracker = vision_tracker::readTracker(path).tracker;
  sim_bullet::CameraRigOptions rig = sim_bullet::readCameraRig(path);
};

}  // namespace fastball::bench
