#pragma once

#include <Eigen/Core>

#include "model/hand.h"

namespace fastball::planner {

/// Hand and ball in the tool frame for given wrist angles, with the derivatives by roll and flexion [rad].
struct HeldBall {
  HeldBall(const model::Hand& hand, double roll, double flexion);

  Eigen::Matrix3d R_TH, R_by_roll, R_by_flexion;
  Eigen::Vector3d p_TBall, p_by_roll, p_by_flexion;  ///< [m], [m/rad]
};

}  // namespace fastball::planner
