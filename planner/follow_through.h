#pragma once

#include <Eigen/Core>

#include "model/trajectory.h"
#include "planner/motion_gradient.h"

namespace fastball::planner {

/// How the arm comes to rest after the release.
struct FollowThrough {
  double delay = 0;  ///< [s], the base functions go on for this time after the swing's t = 0
  Eigen::Vector4d brake_time =
      Eigen::Vector4d::Zero();  ///< [s], then each joint comes to rest in this time

  /// The motion t [s] after braking began in motion `from`: a quartic to rest for each joint.
  model::ArmMotion braked(const model::ArmMotion& from, double t) const;
  /// Derivatives by `from` of what has the derivatives `g` by braked(from, t).
  MotionGradient beforeBraking(const MotionGradient& g, double t) const;
};

}  // namespace fastball::planner
