#pragma once

#include "model/hand.h"

namespace fastball::model {

/// What the hand's servo is told, one entry a joint.
struct JointTargets {
  HandVector q = HandVector::Zero();    ///< [rad]
  HandVector qd = HandVector::Zero();   ///< [rad/s]
  HandVector tau = HandVector::Zero();  ///< [N m], feed-forward
  HandVector kp = HandVector::Zero();   ///< [N m/rad]
  HandVector kd = HandVector::Zero();   ///< [N m s/rad]
};

}  // namespace fastball::model
