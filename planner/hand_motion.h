#pragma once

#include <Eigen/Core>

#include "model/arm.h"
#include "model/hand.h"
#include "model/release.h"
#include "model/trajectory.h"

namespace fastball::planner {

struct WristAngles {
  double roll = 0, flexion = 0;  ///< [rad]
};

/// How the hand must be turned for a throw.
struct ThrowDirection {
  Eigen::Vector3d y_WH;  ///< unit vector along the ball's velocity
  WristAngles
      wrist;  ///< put y of H there, so that Eq. (25) holds: the ball does not move along x or z of H
  double speed = 0;  ///< [m/s], of the ball in the hand so turned
};
/// Of the hand that the arm's motion carries along. The wrist moves the ball, and with it the
/// velocity: solved by iteration.
ThrowDirection throwDirection(const model::Arm& arm,
                              const model::Hand& hand,
                              const model::ArmMotion& motion);

/// The hand frame's motion that an arm motion makes, the wrist held.
model::HandMotion handMotion(const model::Arm& arm,
                             const model::Hand& hand,
                             const WristAngles& wrist,
                             const model::ArmMotion& motion);

}  // namespace fastball::planner
