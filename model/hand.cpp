#include "model/hand.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace fastball::model {
namespace {

/// The plane in which a finger flexes, in H: u points outwards from the z axis, t = z x u.
struct FingerPlane {
  Eigen::Vector3d p_base, u, t;

  /// Direction of a phalanx that is flexed by `angle` from parallel to z.
  Eigen::Vector3d direction(double angle) const {
    return std::cos(angle) * Eigen::Vector3d::UnitZ() - std::sin(angle) * u;
  }
  /// Positive flexion turns about this axis, from z towards the z axis of H.
  Eigen::Vector3d flexionAxis() const { return -t; }
};

Eigen::Vector3d radial(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth), 0};
}

double spreadAngle(Finger finger, const HandVector& q) {
  return finger == kThumb ? 0 : q[Hand::proximalJoint(finger) - 1];
}

FingerPlane planeOf(const HandParameters& hand, Finger finger, double spread) {
  const double azimuth = hand.azimuth[finger];
  FingerPlane plane;
  plane.p_base = hand.base_radius * radial(azimuth) + hand.base_distance * Eigen::Vector3d::UnitZ();
  plane.u = radial(azimuth + spread);
  plane.t = Eigen::Vector3d::UnitZ().cross(plane.u);
  return plane;
}

}  // namespace

Hand::Hand(const HandParameters& parameters) : parameters_(parameters) {}

int Hand::proximalJoint(Finger finger) {
  switch (finger) {
    case kFingerA:
      return kProximalA;
    case kThumb:
      return kProximalThumb;
    case kFingerB:
      return kProximalB;
  }
  return kProximalThumb;
}

Eigen::Isometry3d Hand::X_TH(double roll, double flexion) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(flexion, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

std::array<Segment, 2> Hand::phalanges(Finger finger, const HandVector& q) const {
  const FingerPlane plane = planeOf(parameters_, finger, spreadAngle(finger, q));
  const int proximal = proximalJoint(finger);
  const Eigen::Vector3d p_elbow =
      plane.p_base + parameters_.proximal_length * plane.direction(q[proximal]);
  const Eigen::Vector3d p_tip =
      p_elbow + parameters_.distal_length * plane.direction(q[proximal] + q[proximal + 1]);
  return {Segment{plane.p_base, p_elbow}, Segment{p_elbow, p_tip}};
}

Eigen::Vector3d Hand::parallelFinger(double distance) const {
  const double inward = parameters_.base_radius - distance;
  if (!(std::abs(inward) <= parameters_.proximal_length)) {
    std::ostringstream message;
    message << "finger cannot hold its distal phalanx " << distance
            << " m from the hand's z axis: with its base at " << parameters_.base_radius
            << " m and a proximal phalanx of " << parameters_.proximal_length << " m it reaches "
            << parameters_.base_radius - parameters_.proximal_length << " to "
            << parameters_.base_radius + parameters_.proximal_length << " m";
    throw std::invalid_argument(message.str());
  }
  const double proximal = std::asin(inward / parameters_.proximal_length);
  return {0, proximal, -proximal};
}

HandVector Hand::posture(double roll,
                         double flexion,
                         const std::array<double, kFingers>& distances) const {
  HandVector q = HandVector::Zero();
  q[kWristRoll] = roll;
  q[kWristFlexion] = flexion;
  for (const Finger finger : {kFingerA, kThumb, kFingerB}) {
    const Eigen::Vector3d angles = parallelFinger(distances[finger]);
    const int proximal = proximalJoint(finger);
    if (finger != kThumb)
      q[proximal - 1] = angles[0];
    q[proximal] = angles[1];
    q[proximal + 1] = angles[2];
  }
  return q;
}

Eigen::Vector3d Hand::fingerTorque(Finger finger,
                                   const HandVector& q,
                                   const Eigen::Vector3d& p_H,
                                   const Eigen::Vector3d& force_H) const {
  const FingerPlane plane = planeOf(parameters_, finger, spreadAngle(finger, q));
  const Eigen::Vector3d p_elbow =
      plane.p_base + parameters_.proximal_length * plane.direction(q[proximalJoint(finger)]);
  // Virtual work: torque = moment of the force about each joint's axis.
  const Eigen::Vector3d base_moment = (p_H - plane.p_base).cross(force_H);
  const Eigen::Vector3d elbow_moment = (p_H - p_elbow).cross(force_H);
  return {finger == kThumb ? 0 : base_moment.z(), plane.flexionAxis().dot(base_moment),
          plane.flexionAxis().dot(elbow_moment)};
}

}  // namespace fastball::model
