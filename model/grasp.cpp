#include "model/grasp.h"

#include <Eigen/LU>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "model/contact.h"

namespace fastball::model {
namespace {

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// Normal forces [N] of the three fingers: those of A and B such that the three add up to nothing.
std::array<double, kFingers> balance(const std::array<Eigen::Vector3d, kFingers>& normals,
                                     double grip_force) {
  Eigen::Matrix2d rear;
  rear << normals[kFingerA].head<2>(), normals[kFingerB].head<2>();
  // Parallel normals leave no solution, or one of enormous forces.
  constexpr double kLeastDeterminant = 1e-6;
  if (std::abs(rear.determinant()) < kLeastDeterminant)
    refuse("fingers A and B press along the same line and cannot hold the ball sideways");
  const Eigen::Vector2d forces = rear.inverse() * (-grip_force * normals[kThumb].head<2>());
  if (grip_force > 0 && forces.minCoeff() < 0)
    refuse("the fingers do not surround the ball: with a thumb force of ", grip_force,
           " N, fingers A and B would have to press with ", forces[0], " and ", forces[1], " N");
  return {forces[0], grip_force, forces[1]};
}

void requireDistalContact(const Hand& hand, Finger finger, const HandVector& q, double z) {
  const Segment distal = hand.phalanges(finger, q)[1];
  if (z < distal.p_start.z() || z > distal.p_end.z())
    refuse("finger ", static_cast<int>(finger), " would hold the ball at ", z,
           " m from the tool plate, its distal phalanx reaches from ", distal.p_start.z(), " to ",
           distal.p_end.z(), " m");
}

}  // namespace

HandVector GraspGeometry::torques() const {
  HandVector tau = HandVector::Zero();
  for (const Finger finger : {kFingerA, kThumb, kFingerB}) {
    const int proximal = Hand::proximalJoint(finger);
    tau.segment<2>(proximal) = fingers[finger].torque.tail<2>();
    if (finger != kThumb)
      tau[proximal - 1] = fingers[finger].torque[0];
  }
  return tau;
}

GraspGeometry grasp(const BallParameters& ball, const Hand& hand, double grip_force) {
  const HandParameters& parameters = hand.parameters();
  const Eigen::Vector3d& p_HBall = parameters.p_HBall;
  if (p_HBall.head<2>().norm() > 1e-9)
    refuse("the ball's place in the hand (", p_HBall.x(), ", ", p_HBall.y(), ", ", p_HBall.z(),
           ") m is not on the hand's z axis");
  std::array<Eigen::Vector3d, kFingers> normals;
  for (int i = 0; i < kFingers; ++i)
    normals[i] = {-std::cos(parameters.azimuth[i]), -std::sin(parameters.azimuth[i]), 0};
  const std::array<double, kFingers> forces = balance(normals, grip_force);

  GraspGeometry result;
  for (int i = 0; i < kFingers; ++i) {
    FingerGrasp& finger = result.fingers[i];
    finger.n_H = normals[i];
    finger.force = forces[i];
    finger.deformation = deformation(ball, finger.force);
    finger.distance = ball.radius + parameters.finger_radius - finger.deformation;
    finger.p_H = p_HBall - (ball.radius - finger.deformation) * finger.n_H;
  }
  result.q = hand.posture(0, 0, result.distances());
  for (const Finger i : {kFingerA, kThumb, kFingerB}) {
    FingerGrasp& finger = result.fingers[i];
    requireDistalContact(hand, i, result.q, p_HBall.z());
    finger.torque = hand.fingerTorque(i, result.q, finger.p_H, finger.force * finger.n_H);
  }
  return result;
}

}  // namespace fastball::model
