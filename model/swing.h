#pragma once

#include <Eigen/Core>

#include "model/base_value.h"

namespace fastball::model {

/// alpha sin(omega t + phi) + c between t_s and t_e, where its speed is zero (Eqs. 10, 12, 14); constant before and after.
struct SinBase {
  double alpha = 0;      ///< [rad]
  double omega = 0;      ///< [rad/s], positive
  double phi = 0;        ///< [rad]
  double c = 0;          ///< [rad]
  double start() const;  ///< t_s [s]
  double end() const;    ///< t_e [s]
  BaseValue at(double t) const;
};

/// amplitude e^{omega (t - t_switch)} + c up to t_switch; there omega changes its sign (section 2.3), and amplitude and c with
/// it so that position and velocity are continuous. `amplitude` is alpha2 e^{phi2 + omega t_switch}: one parameter.
struct ExpBase {
  double amplitude = 0;  ///< [rad]
  double omega = 0;      ///< [1/s], positive
  double t_switch = 0;   ///< [s]
  double c = 0;          ///< [rad]
  BaseValue at(double t) const;
};

/// Angles [rad] of the analogous swing model (section 2.6) with their rates: upper arm at polar
/// angle gamma and azimuth q1, forearm at polar angle gamma + q2 and azimuth q1 + q3.
struct SwingAngles {
  Eigen::Vector3d q = Eigen::Vector3d::Zero(), qd = Eigen::Vector3d::Zero(),
                  qdd = Eigen::Vector3d::Zero();
};

/// The same motion in WAM joints: J1 = q1, J2 = gamma, (J3, J4) point the forearm; with velocities and accelerations.
/// The elbow branch is chosen by `elbow_sign` (+1: J4 >= 0, -1: J4 <= 0); J3 is continuous from call to call if the previous
/// value is given in `q3_near`. Singular where the forearm lies along the upper arm (J4 = 0).
struct WamMotion {
  Eigen::Vector4d q, qd, qdd;  ///< [rad], [rad/s], [rad/s^2]
};
WamMotion wamFromSwing(const SwingAngles& swing, double gamma, int elbow_sign, double q3_near);
/// The same with an upper arm whose polar angle moves.
WamMotion wamFromSwing(const SwingAngles& swing,
                       const BaseValue& gamma,
                       int elbow_sign,
                       double q3_near);

/// The WAM's motion with its first derivatives by z = (q1, q2, q3, gamma). With q = f(z), qd = F zd and so on:
/// dq/dz = dqd/dzd = dqdd/dzdd = F, dqd/dz = Fd, dqdd/dzd = 2 Fd, dqdd/dz = Fdd. Rows 3 and 4 are zero in the straight elbow.
struct WamDerivatives {
  WamMotion motion;
  Eigen::Matrix4d F, Fd, Fdd;
};
WamDerivatives wamDerivatives(const SwingAngles& swing,
                              const BaseValue& gamma,
                              int elbow_sign,
                              double q3_near);

}  // namespace fastball::model
