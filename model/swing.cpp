#include "model/swing.h"

#include <cmath>

namespace fastball::model {

double SinBase::start() const {
  return (-M_PI / 2 - phi) / omega;
}

double SinBase::end() const {
  return (M_PI / 2 - phi) / omega;
}

BaseValue SinBase::at(double t) const {
  if (t <= start())
    return {c - alpha, 0, 0};
  if (t >= end())
    return {c + alpha, 0, 0};
  const double s = std::sin(omega * t + phi);
  return {c + alpha * s, alpha * omega * std::cos(omega * t + phi), -alpha * omega * omega * s};
}

BaseValue ExpBase::at(double t) const {
  if (t <= t_switch) {
    const double e = amplitude * std::exp(omega * (t - t_switch));
    return {c + e, omega * e, omega * omega * e};
  }
  // Equal position and velocity at the switch: the amplitude turns its sign and c moves by twice
  // the amplitude.
  const double e = amplitude * std::exp(-omega * (t - t_switch));
  return {c + 2 * amplitude - e, omega * e, -omega * omega * e};
}

namespace {

/// A vector that moves, with its derivatives.
struct MovingVector {
  Eigen::Vector3d l, ld, ldd;
};

/// Direction with polar angle theta (from z) and azimuth psi (from x).
MovingVector direction(const BaseValue& theta, const BaseValue& psi) {
  const double st = std::sin(theta.q), ct = std::cos(theta.q);
  const Eigen::Vector3d r(std::cos(psi.q), std::sin(psi.q), 0);
  const Eigen::Vector3d e_psi(-r.y(), r.x(), 0);
  const Eigen::Vector3d l = st * r + ct * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d e_theta = ct * r - st * Eigen::Vector3d::UnitZ();
  // Velocity and acceleration in spherical coordinates at radius 1.
  const Eigen::Vector3d ld = theta.qd * e_theta + psi.qd * st * e_psi;
  const Eigen::Vector3d ldd = theta.qdd * e_theta - theta.qd * theta.qd * l +
                              (psi.qdd * st + 2 * theta.qd * psi.qd * ct) * e_psi -
                              psi.qd * psi.qd * st * r;
  return {l, ld, ldd};
}

double nearest(double angle, double near) {
  return angle + 2 * M_PI * std::round((near - angle) / (2 * M_PI));
}

/// Joints 3 and 4 that point the forearm along the unit vector m.l, in the frame of the upper arm.
struct Elbow {
  BaseValue q3, q4;
};

Elbow elbow(const MovingVector& m, int elbow_sign, double q3_near) {
  const double sign = elbow_sign < 0 ? -1 : 1;
  const Eigen::Vector2d u = m.l.head<2>(), ud = m.ld.head<2>(), udd = m.ldd.head<2>();
  const double rho = u.norm();
  Elbow result;
  // Straight: joint 3 has no influence on the direction; it stays, and joint 4 alone takes the
  // speed.
  constexpr double kStraight = 1e-9;
  if (rho < kStraight) {
    const double upwards = m.l.z() < 0 ? -1 : 1;
    result.q3 = {q3_near, 0, 0};
    result.q4 = {sign * std::atan2(rho, m.l.z()), sign * upwards * ud.norm(), 0};
    return result;
  }
  const double dot = u.dot(ud), cross = u.x() * ud.y() - u.y() * ud.x();
  const double q3d = cross / (rho * rho);
  const double q3dd = (u.x() * udd.y() - u.y() * udd.x() - 2 * dot * q3d) / (rho * rho);
  const double rho_d = dot / rho;
  const double rho_dd = (ud.squaredNorm() + u.dot(udd) - rho_d * rho_d) / rho;
  result.q3 = {nearest(std::atan2(sign * u.y(), sign * u.x()), q3_near), q3d, q3dd};
  result.q4 = {sign * std::atan2(rho, m.l.z()), sign * (m.l.z() * rho_d - rho * m.ld.z()),
               sign * (m.l.z() * rho_dd - rho * m.ldd.z())};
  return result;
}

}  // namespace

WamMotion wamFromSwing(const SwingAngles& swing, double gamma, int elbow_sign, double q3_near) {
  MovingVector m = direction({gamma + swing.q[1], swing.qd[1], swing.qdd[1]},
                             {swing.q[2], swing.qd[2], swing.qdd[2]});
  Eigen::Matrix3d turn;  // by -gamma about y, into the frame of the upper arm
  turn << std::cos(gamma), 0, -std::sin(gamma), 0, 1, 0, std::sin(gamma), 0, std::cos(gamma);
  m = {turn * m.l, turn * m.ld, turn * m.ldd};
  const Elbow joints = elbow(m, elbow_sign, q3_near);
  WamMotion wam;
  wam.q << swing.q[0], gamma, joints.q3.q, joints.q4.q;
  wam.qd << swing.qd[0], 0, joints.q3.qd, joints.q4.qd;
  wam.qdd << swing.qdd[0], 0, joints.q3.qdd, joints.q4.qdd;
  return wam;
}

}  // namespace fastball::model
