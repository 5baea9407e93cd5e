#pragma once

#include <Eigen/Core>

namespace fastball::planner {

/// Derivatives of a number by an arm's positions, speeds and accelerations at one time.
struct MotionGradient {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  Eigen::Vector4d qd = Eigen::Vector4d::Zero();
  Eigen::Vector4d qdd = Eigen::Vector4d::Zero();
};

}  // namespace fastball::planner
