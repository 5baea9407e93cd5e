#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "model/ball_parameters.h"
#include "model/hand_parameters.h"

namespace fastball::model {

using HandVector = Eigen::Matrix<double, kHandJoints, 1>;

/// A capsule's axis, in H where the hand gives it.
struct Segment {
  Eigen::Vector3d p_start, p_end;  ///< [m]
};

/// Kinematics of the hand: where the phalanges are for given joint angles, and which joint angles put a finger where.
/// A finger flexes in its own plane, through the z axis of H when its spread is zero; a positive spread turns that plane about
/// +z through the finger's base. Proximal angle 0: the proximal phalanx is parallel to z; positive angles close towards the z
/// axis. The distal angle is relative to the proximal phalanx.
class Hand {
 public:
  explicit Hand(const HandParameters& parameters);
  const HandParameters& parameters() const { return parameters_; }

  /// Pose of the hand frame in the tool frame for the two wrist angles: roll about z of T, then flexion about x.
  Eigen::Isometry3d X_TH(double roll, double flexion) const;
  /// Axes of the proximal and the distal phalanx in H.
  std::array<Segment, 2> phalanges(Finger finger, const HandVector& q) const;
  /// Joint angles [rad] of any finger (spread, proximal, distal) that hold its distal phalanx
  /// parallel to z, its axis `distance` [m] from the z axis of H on the finger's own side.
  /// @throw std::invalid_argument if the proximal phalanx is too short for that.
  Eigen::Vector3d parallelFinger(double distance) const;
  /// All joints [rad] of the hand: wrist as given, each finger's distal phalanx parallel to z at
  /// its distance [m].
  /// @throw std::invalid_argument as parallelFinger().
  HandVector posture(double roll,
                     double flexion,
                     const std::array<double, kFingers>& distances) const;
  /// Joint torques [N m] (spread, proximal, distal) that balance `force_H` [N] applied BY the finger at point p_H of its
  /// distal phalanx: transposed Jacobian times force. The thumb's first entry is 0.
  Eigen::Vector3d fingerTorque(Finger finger,
                               const HandVector& q,
                               const Eigen::Vector3d& p_H,
                               const Eigen::Vector3d& force_H) const;
  /// First joint index of a finger's flexion (proximal); the distal one follows, the spread joint
  /// of finger A or B precedes it.
  static int proximalJoint(Finger finger);
  /// A finger's joints: those of its flexion and, before them, a spread joint if it has one.
  struct JointRange {
    int first, joints;
  };
  static JointRange jointsOf(Finger finger) {
    const int spread = finger == kThumb ? 0 : 1;
    return {proximalJoint(finger) - spread, 2 + spread};
  }

 private:
  HandParameters parameters_;
};

}  // namespace fastball::model
