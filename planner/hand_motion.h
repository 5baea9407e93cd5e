#pragma once

#include <Eigen/Core>

#include "model/arm.h"
#include "model/hand.h"
#include "model/release.h"
#include "model/trajectory.h"

namespace fastball::planner {

/// How the hand must be turned for a throw.
struct ThrowDirection {
  Eigen::Vector3d y_WH;   ///< unit vector: ball velocity's component across the forearm
  double wrist_roll = 0;  ///< [rad], wrist roll that puts y of H there
};
ThrowDirection throwDirection(const model::Arm& arm,
                              const model::ArmMotion& motion,
                              const Eigen::Vector3d& p_TBall);

/// The hand frame's motion that an arm motion makes, the wrist held at `roll` [rad] and no flexion.
model::HandMotion handMotion(const model::Arm& arm,
                             const model::Hand& hand,
                             double roll,
                             const model::ArmMotion& motion);

}  // namespace fastball::planner
