#pragma once

#include <string>

#include "config/strict_yaml.h"
#include "model/arm_parameters.h"
#include "model/ball_parameters.h"
#include "model/hand_parameters.h"
#include "model/target.h"

namespace fastball::config {

/// What more than one process must know: the arm, the hand, the ball, where the net hangs, where
/// the arm rests.
struct Experiment {
  std::string path;
  model::ArmParameters arm;
  model::HandParameters hand;
  model::BallParameters ball;
  model::Target target;
  Eigen::Vector4d q_rest;  ///< [rad], where the arm rests before a throw
};

/// Reads the shared part of an experiment file (keys arm, hand, ball: file names; target, rest:
/// maps). Each process reads its own section (keys planner, controller, hand_server, simulation,
/// cameras, tracker, run) with processSection().
/// @throw ConfigError
Experiment loadExperiment(const std::string& path);

/// The process's own section of the experiment file; every other top-level key is known and left
/// alone, an unknown one is an error.
/// @throw ConfigError
Section processSection(const std::string& path, const std::string& process);

/// The experiment file used when none is named: $FASTBALL_CONFIG, else the config/experiment.yaml
/// installed beside the program, else of the source tree that it was built from.
std::string defaultExperimentPath();

/// `named`, or the default experiment file if it is empty.
std::string experimentPath(const std::string& named);

}  // namespace fastball::config
