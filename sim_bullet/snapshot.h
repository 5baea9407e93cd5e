#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "model/arm.h"
#include "model/hand.h"

namespace fastball::sim_bullet {

/// Where everything that can be seen is at one time; the cameras draw from these.
struct SceneSnapshot {
  int64_t utime = 0;                                  ///< [us], simulated time
  Eigen::Vector3d p_WBall = Eigen::Vector3d::Zero();  ///< [m], ball centre
  Eigen::Matrix3d R_WBall =
      Eigen::Matrix3d::Identity();                  ///< its orientation (the texture turns with it)
  Eigen::Vector4d q_arm = Eigen::Vector4d::Zero();  ///< [rad]
  model::HandVector q_hand = model::HandVector::Zero();  ///< [rad]
};

}  // namespace fastball::sim_bullet
