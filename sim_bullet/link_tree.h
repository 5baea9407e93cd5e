#pragma once

#include <Eigen/Geometry>
#include <array>

#include "model/arm.h"
#include "model/hand.h"

namespace fastball::sim_bullet {

inline constexpr int kJoints = model::kArmJoints + model::kHandJoints;
/// Links are numbered as their joints: the arm's four, then the hand's ten.
inline constexpr int kHandLink = model::kArmJoints + model::kWristFlexion;

/// One moving part: its body and how it hangs on its parent, both in its own reference frame F. F is DH frame i for the arm's
/// links, the hand frame H for the palm, and for a finger's links a frame with z along the phalanx and x away from the
/// hand's axis, its origin on the joint axis.
struct LinkSpec {
  int parent = -1;                                         ///< -1: the base
  Eigen::Isometry3d X_PF = Eigen::Isometry3d::Identity();  ///< in the parent's F, joint at zero
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();       ///< unit vector of the joint's axis
  Eigen::Vector3d p_FAxis = Eigen::Vector3d::Zero();       ///< [m], a point on it
  model::RigidBody body;                                   ///< in F
  double drive_inertia =
      0;  ///< [kg m^2], added to the body's inertia along the axis; the arm's links have 0 here
};

using LinkTree = std::array<LinkSpec, kJoints>;

/// Arm and hand as a tree of links. A phalanx is a solid cylinder of the finger's radius with half of the finger's mass; a
/// spread joint moves no mass of its own, and neither does the wrist's roll: palm and wrist are one body after both.
LinkTree linkTree(const model::ArmParameters& arm, const model::HandParameters& hand);

/// The hand's links as one rigid body in the tool frame, frozen at q; drive inertias of its joints left out.
model::RigidBody frozenHand(const LinkTree& tree,
                            double tool_plate_distance,
                            const model::HandVector& q);

/// Pose of link i's reference frame in its parent's for the joint angle q.
Eigen::Isometry3d jointPose(const LinkSpec& link, double q);

}  // namespace fastball::sim_bullet
