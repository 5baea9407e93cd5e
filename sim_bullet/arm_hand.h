#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "model/arm.h"
#include "model/hand.h"
#include "sim_bullet/link_tree.h"

class btMultiBody;

namespace fastball::sim_bullet {

/// Joint angles or anything else of one number a joint, arm and hand.
struct JointVectors {
  Eigen::Vector4d arm = Eigen::Vector4d::Zero();
  model::HandVector hand = model::HandVector::Zero();
};

/// Where a link's reference frame F (see LinkSpec) is and how it moves, in the world.
struct LinkMotion {
  Eigen::Isometry3d X_WF = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_WF = Eigen::Vector3d::Zero();  ///< [m/s], of F's origin
  Eigen::Vector3d w_WF = Eigen::Vector3d::Zero();  ///< [rad/s]

  /// Velocity [m/s] of the link's material point at p_W.
  Eigen::Vector3d velocityAt(const Eigen::Vector3d& p_W) const {
    return v_WF + w_WF.cross(p_W - X_WF.translation());
  }
};

/// The WAM and the hand as one fixed-base btMultiBody of 14 joints, driven by torque. Damping, self-collision and sleeping are
/// off; friction, stops and actuators are the caller's.
class ArmHand {
 public:
  enum class Fingers {
    kMoving,
    kFrozen  ///< the hand's joints are fixed: 4 joints in all, to compare with model::Arm
  };
  /// @param q_hand joint angles of the hand, at rest; the arm starts at zero.
  ArmHand(const model::ArmParameters& arm,
          const model::HandParameters& hand,
          const model::HandVector& q_hand,
          Fingers fingers = Fingers::kMoving);
  ~ArmHand();
  ArmHand(const ArmHand&) = delete;
  ArmHand& operator=(const ArmHand&) = delete;

  btMultiBody& body();
  const LinkTree& tree() const { return tree_; }

  /// [rad], [rad/s]; a frozen hand's joints stay as they were frozen.
  void setState(const JointVectors& q, const JointVectors& qd);
  JointVectors q() const;
  JointVectors qd() const;

  /// Adds joint torques [N m] for the coming step; Bullet forgets them after it.
  void addTorques(const JointVectors& tau);
  /// Adds a force [N] at a point [m] of a link for the coming step, both in the world. Needs updateKinematics().
  void addForceAt(int link, const Eigen::Vector3d& p_W, const Eigen::Vector3d& f_W);
  /// Adds a torque [N m], in the world, on a link for the coming step.
  void addMoment(int link, const Eigen::Vector3d& m_W);

  /// Makes motion() current. Bullet's own cached poses are one step old after a step.
  void updateKinematics();
  const LinkMotion& motion(int link) const { return motion_[link]; }

  /// Corrects the joint velocities that Bullet has just computed without the arm's drive inertia D; called inside the step.
  ///
  /// Bullet has no armature. Its step gave qdd0 = W (tau - b) with the inverse mass matrix W of the links alone; wanted is
  /// (M + D) qdd = tau - b. D is not zero only on the arm's four joints a, so by the matrix inversion lemma
  ///     (1 + W_aa D) qdd_a = qdd0_a,    qdd = qdd0 - W_:a D qdd_a
  /// with W_:a from four passes of Bullet's own algorithm. This is exact, whatever the fingers and the contacts do, and
  /// feeds nothing measured back into the torques.
  /// @param qd_before velocities of the arm before the step [rad/s].
  void addDriveInertia(const Eigen::Vector4d& qd_before, double dt);

  /// Kinetic energy of links and drives, and potential energy of the links [J] (zero at the
  /// shoulder's height); gravity [m/s^2].
  double energy(double gravity);

 private:
  struct Scratch;
  void build(const model::HandVector& q_hand, Fingers fingers);

  LinkTree tree_;
  Eigen::Vector4d drive_inertia_;
  model::HandVector q_frozen_;
  int hand_joints_;  ///< that move: all or none
  std::unique_ptr<btMultiBody> body_;
  std::unique_ptr<Scratch> scratch_;
  std::array<Eigen::Matrix3d, kJoints>
      R_FPrincipal_;  ///< Bullet's link frame: principal axes at the centre of mass
  std::array<LinkMotion, kJoints> motion_;
};

}  // namespace fastball::sim_bullet
