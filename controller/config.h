#pragma once

#include <Eigen/Core>
#include <string>

#include "controller/control_law.h"

namespace fastball::controller {

/// The section `controller` of an experiment file, where each number has its reason.
struct ControllerConfig {
  Law law = Law::kFeedForward;
  Eigen::Vector4d kp = Eigen::Vector4d::Zero();  ///< [N m/rad]
  Eigen::Vector4d kd = Eigen::Vector4d::Zero();  ///< [N m s/rad]
  double start_tolerance = 0;      ///< [rad], a plan must start this near to where the arm is
  double blend_time = 0;           ///< [s], in which the rest of that distance is made up
  double grip_correction_max = 0;  ///< [rad], of a joint, for a ball that lies off its place
  double tracking_bound = 0;       ///< [rad], the arm brakes if a joint is further off than this
  double overspeed = 0;            ///< the arm brakes above this multiple of the speed limit
  double stale_limit = 0;          ///< [s], the arm brakes if it hears of no state for longer
  double brake_share = 0;          ///< share of the torque limits that braking plans with
};

/// Reads the section `controller` of the experiment file at `path`.
/// @throw config::ConfigError
ControllerConfig loadConfig(const std::string& path);

}  // namespace fastball::controller
