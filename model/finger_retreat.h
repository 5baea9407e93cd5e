#pragma once

#include <array>

#include "model/grasp.h"
#include "model/hand.h"
#include "model/joint_targets.h"

namespace fastball::model {

/// Fingers that go back from the ball they hold in proportion to how deep they press, so that all of them let go at once whatever
/// the ball's stiffness: with the way w, 0 in the grasp and 1 where a ball as the grasp takes it is no longer pressed,
///     distance of a finger from the axis  d = d_grasp + w y,      its pressing torque  tau_grasp max(0, 1 - w)^2,
/// y the ball's deformation under that finger. No function allocates.
class FingerRetreat {
 public:
  FingerRetreat() = default;
  /// @param grasp what the hand holds; its joint torques are the feed-forward.
  FingerRetreat(const Hand& hand, const GraspGeometry& grasp);

  /// Sets q, qd and tau of the finger's proximal and distal joint.
  /// @param rate dw/dt [1/s].
  void tell(Finger finger, double way, double rate, JointTargets& targets) const;
  /// Of the whole hand in the grasp: [rad], [N m].
  const HandVector& q_grasp() const { return q_grasp_; }
  const HandVector& tau_grasp() const { return tau_grasp_; }

 private:
  double proximalAngle(Finger finger, double way) const;

  double base_radius_ = 0, proximal_length_ = 1;
  std::array<double, kFingers> distance_{}, deformation_{};  ///< [m], of the grasp
  HandVector q_grasp_ = HandVector::Zero(), tau_grasp_ = HandVector::Zero();
};

}  // namespace fastball::model
