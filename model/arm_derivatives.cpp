#include "model/arm_derivatives.h"

#include "model/arm_rotation.h"

// The arm in axes that turn with joint 1, which is vertical, and about the shoulder centre: sums
// over bodies need no shifts, and joint 1 turns nothing that these axes see. With S a joint's twist,
// v and a those of the link below and their rate (gravity included), S' = v x S and S'' = a x S +
// v x S', the acceleration of a point r with velocity u beyond the joint changes
//   with its angle by S''(r) + 2 S'.w x u, seen by an eye that turns with the joint,
//   with its speed by 2 (S'(r) + S.w x u),
//   with its acceleration by S(r).
// Torques of the joints above feel this in their own bodies only, those of the joints below in all
// bodies beyond the joint.
namespace fastball::model {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Force and its moment about the origin.
struct Wrench {
  Vector3d f;
  Vector3d n;

  void operator+=(const Wrench& other) {
    f += other.f;
    n += other.n;
  }
};

/// A vector field v + w x r: a twist, or a rate of one.
struct Field {
  Vector3d w;
  Vector3d v;

  void add(const Field& other, double factor) {
    w += other.w * factor;
    v += other.v * factor;
  }
  double power(const Wrench& wrench) const { return w.dot(wrench.n) + v.dot(wrench.f); }
};

/// Rate of a field that the twist carries along.
inline Field carried(const Field& twist, const Field& field) {
  return {twist.w.cross(field.w), twist.w.cross(field.v) + twist.v.cross(field.w)};
}

/// Rate of a wrench that the twist carries along.
inline Wrench carried(const Field& twist, const Wrench& wrench) {
  return {twist.w.cross(wrench.f), twist.w.cross(wrench.n) + twist.v.cross(wrench.f)};
}

/// Sums over the points r, with mass dm and velocity u, of one or more bodies.
struct Bodies {
  double m;       ///< [kg]
  Vector3d h;     ///< [kg m], sum of r dm
  Matrix3d K;     ///< [kg m^2], sum of r r' dm
  Vector3d P;     ///< [kg m/s], sum of u dm
  Matrix3d Q;     ///< [kg m^2/s], sum of u r' dm
  Wrench wrench;  ///< that moves them as they move

  void operator+=(const Bodies& other) {
    m += other.m;
    h += other.h;
    K += other.K;
    P += other.P;
    Q += other.Q;
    wrench += other.wrench;
  }
  /// That gives every point the acceleration field(r).
  Wrench along(const Field& field) const {
    return {m * field.v + field.w.cross(h), K.trace() * field.w - K * field.w + h.cross(field.v)};
  }
  /// That gives every point the acceleration w x u.
  Wrench across(const Vector3d& w) const { return {w.cross(P), Q.trace() * w - Q * w}; }
  /// The vector whose product with w is the power of across(w) on the twist.
  Vector3d powerAcross(const Field& twist) const {
    return Q.trace() * twist.w - Q.transpose() * twist.w + P.cross(twist.v);
  }
  /// P, Q and the wrench of one body from its twist and its rate.
  void move(const Field& twist, const Field& rate) {
    P = m * twist.v + twist.w.cross(h);
    for (int k = 0; k < 3; ++k) {
      Q.col(k) = twist.v * h[k] + twist.w.cross(K.col(k));
    }
    const Vector3d spin(Q(2, 1) - Q(1, 2), Q(0, 2) - Q(2, 0), Q(1, 0) - Q(0, 1));
    wrench = along(rate);
    wrench += carried(twist, Wrench{P, spin});
  }
};

/// m, h and K of one body at the orientation R and the position p, from the mass, the first moment
/// and the inertia tensor in its own frame.
inline Bodies placed(double mass,
                     const Vector3d& h,
                     const Matrix3d& I,
                     const Matrix3d& R,
                     const Vector3d& p) {
  Bodies body;
  const Vector3d h_turned = R * h;
  body.m = mass;
  body.h = h_turned + mass * p;
  body.K = h_turned * p.transpose() + p * body.h.transpose() - R * I * R.transpose();
  body.K.diagonal().array() += 0.5 * I.trace();
  return body;
}

/// A joint in motion; S, S' and S'' as above.
struct Joint {
  Field S;
  Field S1;
  Field S2;
  Bodies beyond;
};

using Joints = std::array<Joint, kArmJoints>;

/// Row and column i, up to the diagonal, of joint i > 0.
void derive(const Joints& joints, int i, TorqueDerivatives* torque) {
  const auto& [S, S1, S2, bodies] = joints[i];
  const Wrench unit = bodies.along(S);
  const Vector3d across = bodies.powerAcross(S);
  Wrench by_q = bodies.along(S2);
  by_q += bodies.across(2 * S1.w);
  by_q += carried(S, bodies.wrench);
  Wrench by_qd = bodies.along(S1);
  by_qd += bodies.across(S.w);

  torque->tau[i] = S.power(bodies.wrench);
  torque->dtau_dq(i, i) = S2.power(unit) + 2 * S1.w.dot(across);
  torque->dtau_dqd(i, i) = 2 * (S1.power(unit) + S.w.dot(across));
  torque->dtau_dqdd(i, i) = S.power(unit);
  for (int j = 1; j < i; ++j) {
    const Joint& below = joints[j];
    torque->dtau_dq(i, j) = below.S2.power(unit) + 2 * below.S1.w.dot(across);
    torque->dtau_dq(j, i) = below.S.power(by_q);
    torque->dtau_dqd(i, j) = 2 * (below.S1.power(unit) + below.S.w.dot(across));
    torque->dtau_dqd(j, i) = 2 * below.S.power(by_qd);
    torque->dtau_dqdd(i, j) = torque->dtau_dqdd(j, i) = below.S.power(unit);
  }
  // Joint 1: S is the vertical through the origin, S' = S'' = 0.
  torque->dtau_dq(i, 0) = 0;
  torque->dtau_dq(0, i) = by_q.n.z();
  torque->dtau_dqd(i, 0) = 2 * across.z();
  torque->dtau_dqd(0, i) = 2 * by_qd.n.z();
  torque->dtau_dqdd(i, 0) = torque->dtau_dqdd(0, i) = unit.n.z();
}

/// Torque 1 by joint 1, where link 1 has that inertia [kg m^2] about the vertical.
void deriveFirst(const Bodies& others, double inertia, double qdd, TorqueDerivatives* torque) {
  torque->tau[0] = others.wrench.n.z() + inertia * qdd;
  torque->dtau_dq(0, 0) = 0;
  torque->dtau_dqd(0, 0) = 2 * (others.Q(0, 0) + others.Q(1, 1));
  torque->dtau_dqdd(0, 0) = others.K(0, 0) + others.K(1, 1) + inertia;
}

}  // namespace

TorqueDerivatives Arm::inverseDynamicsDerivatives(const Vector4& q,
                                                  const Vector4& qd,
                                                  const Vector4& qdd) const {
  const auto rotation = rotations({0, q[1], q[2], q[3]});
  Joints joints;
  Matrix3d R = rotation[0].matrix();
  Vector3d p = R * links_[0].p;
  const Vector3d up = Vector3d::UnitZ();
  Field twist = {up * qd[0], Vector3d::Zero()};
  Field rate = {up * qdd[0], up * parameters_.gravity};
  for (int i = 1; i < kArmJoints; ++i) {
    const Link& link = links_[i];
    auto& [S, S1, S2, beyond] = joints[i];
    S = {R.col(2), p.cross(R.col(2))};
    S1 = carried(twist, S);
    S2 = carried(rate, S);
    S2.add(carried(twist, S1), 1);
    rate.add(S, qdd[i]);
    rate.add(S1, qd[i]);
    twist.add(S, qd[i]);
    rotation[i].turn(&R);
    p += R * link.p;
    Bodies body = placed(link.mass, link.h, link.I, R, p);
    body.move(twist, rate);
    beyond = body;
  }

  TorqueDerivatives torque;
  for (int i = kArmJoints - 1; i > 1; --i) {
    derive(joints, i, &torque);
    joints[i - 1].beyond += joints[i].beyond;
  }
  derive(joints, 1, &torque);

  const Link& first = links_[0];
  const Vector3d arc = first.axis.cross(first.p);
  const double inertia = first.axis.dot(first.I * first.axis) +
                         arc.dot(2 * first.axis.cross(first.h) + first.mass * arc);
  deriveFirst(joints[1].beyond, inertia, qdd[0], &torque);
  torque.tau += parameters_.drive_inertia.cwiseProduct(qdd);
  torque.dtau_dqdd.diagonal() += parameters_.drive_inertia;
  return torque;
}

}  // namespace fastball::model
