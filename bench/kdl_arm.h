#pragma once

#include <kdl/chain.hpp>
#include <kdl/jntarray.hpp>

#include "model/arm_parameters.h"

/// The arm as Orocos KDL describes it: the independent library that the arm is held against.
namespace fastball::bench {

inline KDL::RigidBodyInertia toKdl(const model::RigidBody& body) {
  const Eigen::Matrix3d& I = body.I_BCom;
  return KDL::RigidBodyInertia(
      body.mass, KDL::Vector(body.p_BCom.x(), body.p_BCom.y(), body.p_BCom.z()),
      KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
}

/// Four joints, and the payload as a body of its own behind a fixed joint.
inline KDL::Chain kdlArm(const model::ArmParameters& parameters, const model::RigidBody& payload) {
  KDL::Chain chain;
  for (int i = 0; i < model::kArmJoints; ++i) {
    const model::DhRow& row = parameters.dh[i];
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ, 1, 0, parameters.drive_inertia[i]),
                                  KDL::Frame::DH(row.a, row.alpha, row.d, 0),
                                  toKdl(parameters.links[i])));
  }
  const KDL::Frame tool(KDL::Vector(0, 0, parameters.tool_plate_distance));
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), tool, toKdl(payload)));
  return chain;
}

inline KDL::JntArray toKdl(const Eigen::Vector4d& value) {
  KDL::JntArray array(model::kArmJoints);
  array.data = value;
  return array;
}

}  // namespace fastball::bench
