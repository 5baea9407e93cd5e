#pragma once

#include <Eigen/Core>
#include <array>

#include "model/hand.h"
#include "model/hand_motion.h"
#include "model/release_motion.h"

namespace fastball::model {

/// Force [N] and moment [N m] about the origin of H, both in H.
struct HandWrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// The two flexing joints of one finger under its drives, the ball and the hand's own motion: two slender phalanges in the
/// finger's plane (its spread joint does not move), the drives' inertia with the phalanx that each turns. The drives: a servo
/// with torque limit, the first-order lag, no torque above the greatest speed.
class FingerBody {
 public:
  /// At rest at q, with the drives' torques at tau.
  FingerBody(const Hand& hand, Finger finger, const HandVector& q, const HandVector& tau);

  /// Proximal and distal phalanx, in H.
  const std::array<Segment, 2>& phalanges() const { return phalanges_; }
  /// Velocity [m/s] in H, relative to it, of the point of a phalanx that lies at p_H.
  Eigen::Vector3d velocityAt(int phalanx, const Eigen::Vector3d& p_H) const;
  /// A force [N] on a phalanx at p_H [m] through the next step.
  void push(int phalanx, const Eigen::Vector3d& p_H, const Eigen::Vector3d& force_H);
  /// Advances by dt [s] (semi-implicit Euler). `gravity` [m/s^2].
  void step(const JointTargets& targets, const HandMotion& hand, double gravity, double dt);
  /// Takes the posture and the speeds of the targets at once, as ideal drives would.
  void follow(const JointTargets& targets);
  /// What the finger's own acceleration relative to the hand did to the hand in the last step.
  const HandWrench& reaction() const { return reaction_; }
  /// Angles [rad] and speeds [rad/s] of the two joints.
  const Eigen::Vector2d& q() const { return q_; }
  const Eigen::Vector2d& qd() const { return qd_; }

 private:
  Eigen::Vector2d driveTorque(const JointTargets& targets, double dt);
  Eigen::Vector2d inertialLoad(const HandMotion& hand, double gravity) const;
  void placePhalanges();

  HandParameters hand_;
  int proximal_;
  Eigen::Vector3d p_base_, u_, axis_;  ///< of the plane, in H; joints turn about the axis
  double phalanx_mass_ = 0;
  Eigen::Vector2d inertia_;  ///< [kg m^2], of a phalanx about its middle, with a drive
  Eigen::Vector2d q_, qd_, tau_;
  Eigen::Vector2d pushed_ = Eigen::Vector2d::Zero();  ///< [N m], by push()
  std::array<Segment, 2> phalanges_;
  HandWrench reaction_;
};

}  // namespace fastball::model
