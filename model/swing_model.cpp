#include "model/swing_model.h"

#include <Eigen/LU>
#include <cmath>

#include "model/rigid_body.h"

namespace fastball::model {
namespace {

double square(double x) {
  return x * x;
}

/// Horizontal unit vector at an azimuth, and the one a quarter turn ahead of it.
Eigen::Vector3d radial(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth), 0};
}
Eigen::Vector3d tangential(double azimuth) {
  return {-std::sin(azimuth), std::cos(azimuth), 0};
}

/// Unit vector at a polar angle and an azimuth.
Eigen::Vector3d direction(double polar, double azimuth) {
  return std::sin(polar) * radial(azimuth) + std::cos(polar) * Eigen::Vector3d::UnitZ();
}
/// Its rate of change.
Eigen::Vector3d directionRate(double polar, double azimuth, double polar_rate, double rate) {
  return polar_rate *
             (std::cos(polar) * radial(azimuth) - std::sin(polar) * Eigen::Vector3d::UnitZ()) +
         rate * std::sin(polar) * tangential(azimuth);
}

}  // namespace

SwingParameters swingParameters(const ArmParameters& arm,
                                const RigidBody& payload,
                                const Eigen::Vector3d& p_TEnd) {
  // Row 3 of the table leads from the shoulder along the upper arm; y of frame 3 points back along
  // it.
  const double upper_arm = arm.dh[2].d;
  const RigidBody& forearm = arm.links[3];
  const double plate = arm.tool_plate_distance;
  SwingParameters p;
  p.m1 = arm.links[2].mass;
  p.L1 = upper_arm;
  p.L1g = upper_arm - arm.links[2].p_BCom.y();
  p.m2 = forearm.mass + payload.mass;
  p.L2 = plate + p_TEnd.z();
  p.L2g = (forearm.mass * forearm.p_BCom.z() + payload.mass * (plate + payload.p_BCom.z())) / p.m2;
  return p;
}

double SwingModel::kineticEnergy(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const {
  return 0.5 * qd.dot(massMatrix(q) * qd);
}

Eigen::Vector3d SwingModel::inverseDynamics(const Eigen::Vector3d& q,
                                            const Eigen::Vector3d& qd,
                                            const Eigen::Vector3d& qdd) const {
  return massMatrix(q) * qdd + h(q, qd);
}

Eigen::Vector3d SwingModel::forwardDynamics(const Eigen::Vector3d& q,
                                            const Eigen::Vector3d& qd,
                                            const Eigen::Vector3d& tau) const {
  return massMatrix(q).partialPivLu().solve(tau - h(q, qd));
}

double SwingModel::passiveBend(const Eigen::Vector3d& q,
                               const Eigen::Vector3d& qd,
                               double qdd1,
                               double qdd3) const {
  const Eigen::Matrix3d M = massMatrix(q);
  return -(h(q, qd)[1] + M(1, 0) * qdd1 + M(1, 2) * qdd3) / M(1, 1);
}

Eigen::Matrix3d LevelSwingModel::massMatrix(const Eigen::Vector3d& q) const {
  const double J2 = i_.J2, A12 = i_.A12, upper = i_.J1 + i_.B2;
  const double S2 = std::sin(q[1]), C2 = std::cos(q[1]), S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  const double M12 = -A12 * C2 * S3, M13 = A12 * S2 * C3 + J2;
  Eigen::Matrix3d M;
  M << upper * S2 * S2 + 2 * A12 * S2 * C3 + J2, M12, M13,  //
      M12, upper, M12,                                      //
      M13, M12, J2;
  return M;
}

Eigen::Vector3d LevelSwingModel::h(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const {
  const double A12 = i_.A12, upper = i_.J1 + i_.B2;
  const double S2 = std::sin(q[1]), C2 = std::cos(q[1]), S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  const double chain = 2 * A12 * C2 * C3 * qd[0] * qd[1];
  return {A12 * S2 * S3 * (square(qd[1]) - square(qd[2]) - 2 * qd[0] * qd[2]) + chain +
              upper * std::sin(2 * q[1]) * qd[0] * qd[1],
          -0.5 * upper * std::sin(2 * q[1]) * square(qd[0]) - A12 * C2 * C3 * square(qd[0] + qd[2]),
          A12 * S2 * S3 * (square(qd[0]) + square(qd[1])) + chain};
}

Eigen::Vector3d LevelSwingModel::lowerArmPoint(const Eigen::Vector3d& q, double along) const {
  return p_.L1 * direction(q[1], q[0]) + along * radial(q[0] + q[2]);
}

Eigen::Vector3d LevelSwingModel::lowerArmVelocity(const Eigen::Vector3d& q,
                                                  const Eigen::Vector3d& qd,
                                                  double along) const {
  return p_.L1 * directionRate(q[1], q[0], qd[1], qd[0]) +
         along * (qd[0] + qd[2]) * tangential(q[0] + q[2]);
}

Eigen::Matrix3d AnalogousSwingModel::massMatrix(const Eigen::Vector3d& q) const {
  const double J2 = i_.J2, A = i_.A12 * std::sin(gamma_);
  const double S = std::sin(gamma_ + q[1]), C = std::cos(gamma_ + q[1]);
  const double S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  const double M12 = A * S3 * C, M13 = (A * C3 + J2 * S) * S, M33 = J2 * S * S;
  Eigen::Matrix3d M;
  M << (i_.J1 + i_.B2) * square(std::sin(gamma_)) + 2 * A * S * C3 + M33, M12, M13,  //
      M12, J2, 0,                                                                    //
      M13, 0, M33;
  return M;
}

Eigen::Vector3d AnalogousSwingModel::h(const Eigen::Vector3d& q, const Eigen::Vector3d& qd) const {
  const double J2 = i_.J2, A = i_.A12 * std::sin(gamma_);
  const double S = std::sin(gamma_ + q[1]), C = std::cos(gamma_ + q[1]);
  const double S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  const double azimuth_rate = qd[0] + qd[2];
  return {2 * (J2 * S + A * C3) * C * qd[1] * azimuth_rate -
              A * S * S3 * (square(qd[1]) + square(qd[2]) + 2 * qd[0] * qd[2]),
          -J2 * S * C * square(azimuth_rate) - A * C3 * C * square(qd[0]),
          2 * J2 * S * C * qd[1] * azimuth_rate + A * S * S3 * square(qd[0])};
}

Eigen::Vector3d AnalogousSwingModel::lowerArmPoint(const Eigen::Vector3d& q, double along) const {
  return p_.L1 * direction(gamma_, q[0]) + along * direction(gamma_ + q[1], q[0] + q[2]);
}

Eigen::Vector3d AnalogousSwingModel::lowerArmVelocity(const Eigen::Vector3d& q,
                                                      const Eigen::Vector3d& qd,
                                                      double along) const {
  return p_.L1 * directionRate(gamma_, q[0], 0, qd[0]) +
         along * directionRate(gamma_ + q[1], q[0] + q[2], qd[1], qd[0] + qd[2]);
}

PrintedSwingModel printedSwingModel(const SwingInertias& inertias,
                                    const Eigen::Vector3d& q,
                                    const Eigen::Vector3d& qd) {
  const auto [J1, J2, A12, B2] = inertias;
  const double S2 = std::sin(q[1]), C2 = std::cos(q[1]), S3 = std::sin(q[2]), C3 = std::cos(q[2]);
  PrintedSwingModel printed;
  const double M23 = -A12 * C2 * S3;
  printed.M << J1 + 4 * J2 * C3 * C3 + 4 * A12 * S2 * C3 + B2, M23, M23, J2;
  printed.h << -0.5 * (J1 + B2) * std::sin(2 * q[1]) * square(qd[0]) -
                   4 * J2 * std::sin(2 * q[2]) * qd[1] * qd[2] -
                   A12 * C2 * C3 *
                       (2 * qd[0] * qd[2] + square(qd[2]) + 2 * square(qd[1]) + square(qd[0])) -
                   4 * A12 * S2 * S3 * qd[1] * qd[2],
      2 * A12 * C2 * C3 * qd[0] * qd[1] + A12 * S2 * S3 * (square(qd[1]) + square(qd[0])) +
          2 * J2 * std::sin(2 * q[2]) * square(qd[1]);
  return printed;
}

double bendByEq7(double q2, double qd1) {
  return 0.5 * square(qd1) * std::sin(2 * q2);
}

double elbowByEq9(const SwingInertias& inertias, double q2, double q3, double qd1) {
  return -inertias.A12 / inertias.J2 * square(qd1) * std::sin(q2) * std::sin(q3);
}

double elbowFrequencyByEq9(const SwingParameters& parameters, double q2, double qd1) {
  return qd1 * std::sqrt(parameters.L1 * std::sin(q2) / parameters.L2g);
}

double bendByEq16(double gamma, double q2, double qd1) {
  return 0.5 * square(qd1) * std::sin(2 * (gamma + q2));
}

double elbowByEq17(const SwingInertias& inertias, double q3, double qd1) {
  return -inertias.A12 / inertias.J2 * square(qd1) * std::sin(q3);
}

}  // namespace fastball::model
