#pragma once

#include <Eigen/Core>

#include "model/arm.h"
#include "model/hand_parameters.h"
#include "model/trajectory.h"

namespace fastball::hand_server {

/// Torques [N m] of the wrist (roll, flexion) that carry the hand and its ball, taken as one rigid body, through the arm's
/// motion: without them the wrist gives way by weight and inertia, and the ball leaves in another direction.
/// @param q_wrist roll and flexion [rad], at rest in the tool frame.
Eigen::Vector2d wristLoad(const model::Arm& arm,
                          const model::HandParameters& hand,
                          const model::ArmMotion& motion,
                          const Eigen::Vector2d& q_wrist);

}  // namespace fastball::hand_server
