#include "model/finger_retreat.h"

#include <algorithm>
#include <cmath>

namespace fastball::model {

FingerRetreat::FingerRetreat(const Hand& hand, const GraspGeometry& grasp)
    : base_radius_(hand.parameters().base_radius),
      proximal_length_(hand.parameters().proximal_length),
      distance_(grasp.distances()),
      q_grasp_(grasp.q),
      tau_grasp_(grasp.torques()) {
  for (int i = 0; i < kFingers; ++i)
    deformation_[i] = grasp.fingers[i].deformation;
}

double FingerRetreat::proximalAngle(Finger finger, double way) const {
  const double inward =
      (base_radius_ - distance_[finger] - way * deformation_[finger]) / proximal_length_;
  return std::asin(std::clamp(inward, -1.0, 1.0));
}

void FingerRetreat::tell(Finger finger, double way, double rate, JointTargets& targets) const {
  const int proximal = Hand::proximalJoint(finger);
  const double left = std::max(0.0, 1 - way);
  targets.tau.segment<2>(proximal) = tau_grasp_.segment<2>(proximal) * (left * left);
  // As Hand::parallelFinger(): the distal phalanx stays parallel to z.
  const double angle = proximalAngle(finger, way);
  const double turning = -rate * deformation_[finger] / (proximal_length_ * std::cos(angle));
  targets.q.segment<2>(proximal) << angle, -angle;
  targets.qd.segment<2>(proximal) << turning, -turning;
}

}  // namespace fastball::model
