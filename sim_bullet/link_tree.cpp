#include "sim_bullet/link_tree.h"

#include "model/rigid_body.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;

void addArm(const model::ArmParameters& arm, LinkTree* tree) {
  for (int i = 0; i < model::kArmJoints; ++i) {
    const model::DhRow& row = arm.dh[i];
    LinkSpec& link = (*tree)[i];
    link.parent = i - 1;
    link.X_PF.translation() = Vector3d(row.a, 0, row.d);
    link.X_PF.linear() = Eigen::AngleAxisd(row.alpha, Vector3d::UnitX()).toRotationMatrix();
    // Joint i turns about z of frame i-1.
    link.axis_F = link.X_PF.linear().transpose() * Vector3d::UnitZ();
    link.p_FAxis = link.X_PF.inverse().translation();
    link.body = arm.links[i];
  }
}

void addWrist(const model::ArmParameters& arm, const model::HandParameters& hand, LinkTree* tree) {
  LinkSpec& roll = (*tree)[model::kArmJoints + model::kWristRoll];
  roll.parent = model::kArmJoints - 1;
  roll.X_PF.translation() = Vector3d(0, 0, arm.tool_plate_distance);
  roll.drive_inertia = hand.wrist_inertia;
  LinkSpec& palm = (*tree)[kHandLink];
  palm.parent = model::kArmJoints + model::kWristRoll;
  palm.axis_F = Vector3d::UnitX();
  palm.body = hand.palm;
  palm.drive_inertia = hand.wrist_inertia;
}

model::RigidBody phalanx(const model::HandParameters& hand, double length) {
  const double mass = hand.finger_mass / 2;
  const double r2 = hand.finger_radius * hand.finger_radius;
  model::RigidBody body;
  body.mass = mass;
  body.p_BCom = Vector3d(0, 0, length / 2);
  const double across = mass * (3 * r2 + length * length) / 12;
  body.I_BCom = Vector3d(across, across, mass * r2 / 2).asDiagonal();
  return body;
}

/// Pose of a finger's base frame in H: x away from the hand's axis, z along it.
Eigen::Isometry3d X_HBase(const model::HandParameters& hand, model::Finger finger) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(hand.azimuth[finger], Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = X.linear() * Vector3d(hand.base_radius, 0, hand.base_distance);
  return X;
}

void addFinger(const model::HandParameters& hand, model::Finger finger, LinkTree* tree) {
  const int proximal = model::kArmJoints + model::Hand::proximalJoint(finger);
  Eigen::Isometry3d X_PF = X_HBase(hand, finger);
  int parent = kHandLink;
  if (finger != model::kThumb) {
    LinkSpec& spread = (*tree)[proximal - 1];
    spread.parent = kHandLink;
    spread.X_PF = X_PF;
    spread.drive_inertia = hand.joint_inertia;
    parent = proximal - 1;
    X_PF.setIdentity();
  }
  const std::array<double, 2> lengths{hand.proximal_length, hand.distal_length};
  for (int i = 0; i < 2; ++i) {
    LinkSpec& link = (*tree)[proximal + i];
    link.parent = parent;
    link.X_PF = X_PF;
    link.axis_F = -Vector3d::UnitY();  // from z towards -x: towards the hand's axis
    link.body = phalanx(hand, lengths[i]);
    link.drive_inertia = hand.joint_inertia;
    parent = proximal + i;
    X_PF = Eigen::Isometry3d(Eigen::Translation3d(0, 0, lengths[i]));
  }
}

}  // namespace

LinkTree linkTree(const model::ArmParameters& arm, const model::HandParameters& hand) {
  LinkTree tree;
  addArm(arm, &tree);
  addWrist(arm, hand, &tree);
  for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB})
    addFinger(hand, finger, &tree);
  return tree;
}

Eigen::Isometry3d jointPose(const LinkSpec& link, double q) {
  return link.X_PF * Eigen::Translation3d(link.p_FAxis) * Eigen::AngleAxisd(q, link.axis_F) *
         Eigen::Translation3d(-link.p_FAxis);
}

model::RigidBody frozenHand(const LinkTree& tree,
                            double tool_plate_distance,
                            const model::HandVector& q) {
  std::array<Eigen::Isometry3d, kJoints> X_TF;
  model::RigidBody hand;
  for (int i = model::kArmJoints; i < kJoints; ++i) {
    const int parent = tree[i].parent;
    const Eigen::Isometry3d X_TP =
        parent < model::kArmJoints
            ? Eigen::Isometry3d(Eigen::Translation3d(0, 0, -tool_plate_distance))
            : X_TF[parent];
    X_TF[i] = X_TP * jointPose(tree[i], q[i - model::kArmJoints]);
    hand = model::combine(hand, model::transformed(X_TF[i], tree[i].body));
  }
  return hand;
}

}  // namespace fastball::sim_bullet
