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

/// A vector that moves, or its derivative by an angle.
struct MovingVector {
  BaseValue x, y, z;
};

/// The forearm's direction in the frame of the upper arm, which is turned by gamma about y.
class Forearm {
 public:
  Forearm(const BaseValue& polar, const BaseValue& azimuth, const BaseValue& gamma)
      : polar_(sinCos(polar)),
        gamma_(sinCos(gamma)),
        azimuth_(sinCos(azimuth)),
        x_(polar_.sin * azimuth_.cos),
        y_(polar_.sin * azimuth_.sin),
        l_(turned({x_, y_, polar_.cos})) {}

  const MovingVector& direction() const { return l_; }
  MovingVector byPolar() const {
    return turned({polar_.cos * azimuth_.cos, polar_.cos * azimuth_.sin, -1 * polar_.sin});
  }
  MovingVector byAzimuth() const { return turned({-1 * y_, x_, {}}); }
  MovingVector byGamma() const { return {-1 * l_.z, {}, l_.x}; }

 private:
  MovingVector turned(const MovingVector& v) const {
    return {v.x * gamma_.cos - v.z * gamma_.sin, v.y, v.x * gamma_.sin + v.z * gamma_.cos};
  }
  SinCos polar_, gamma_, azimuth_;
  BaseValue x_, y_;  ///< before the turn
  MovingVector l_;
};

double nearest(double angle, double near) {
  return angle + 2 * M_PI * std::round((near - angle) / (2 * M_PI));
}

// Below this sine of J4 the elbow is straight: joint 3 has no influence on the direction; it stays, and joint 4 alone takes the
// speed.
constexpr double kStraight = 1e-9;

/// Joints 3 and 4 that point the forearm along l, in the frame of the upper arm.
struct Elbow {
  BaseValue q3, q4;
};

class ElbowMap {
 public:
  ElbowMap(const MovingVector& l, int elbow_sign)
      : l_(l),
        sign_(elbow_sign < 0 ? -1 : 1),
        straight_(l.x.q * l.x.q + l.y.q * l.y.q < kStraight * kStraight) {
    if (!straight_) {
      rho_ = sqrt(l.x * l.x + l.y * l.y);
      inverse_rho_ = inverse(rho_);
    }
  }

  Elbow angles(double q3_near) const {
    if (straight_) {
      const double upwards = l_.z.q < 0 ? -1 : 1;
      return {{q3_near, 0, 0},
              {sign_ * std::atan2(std::hypot(l_.x.q, l_.y.q), l_.z.q),
               sign_ * upwards * std::hypot(l_.x.qd, l_.y.qd), 0}};
    }
    // The rates follow from the derivatives along (dl/dt, d2l/dt2).
    const double i = inverse_rho_.q, cross = l_.x.q * l_.y.qd - l_.y.q * l_.x.qd;
    Elbow result;
    result.q3.q = nearest(std::atan2(sign_ * l_.y.q, sign_ * l_.x.q), q3_near);
    result.q3.qd = cross * i * i;
    result.q3.qdd =
        (l_.x.q * l_.y.qdd - l_.y.q * l_.x.qdd) * i * i - 2 * result.q3.qd * rho_.qd * i;
    result.q4.q = sign_ * std::atan2(rho_.q, l_.z.q);
    result.q4.qd = sign_ * (l_.z.q * rho_.qd - rho_.q * l_.z.qd);
    result.q4.qdd = sign_ * (l_.z.q * rho_.qdd - rho_.q * l_.z.qdd);
    return result;
  }

  /// What a change of l by dl does to the angles.
  Elbow derivative(const MovingVector& dl) const {
    if (straight_)
      return {};
    const BaseValue d_rho = inverse_rho_ * (l_.x * dl.x + l_.y * dl.y);
    return {inverse_rho_ * inverse_rho_ * (l_.x * dl.y - l_.y * dl.x),
            sign_ * (l_.z * d_rho - rho_ * dl.z)};
  }

 private:
  const MovingVector& l_;
  double sign_;
  bool straight_;
  BaseValue rho_, inverse_rho_;
};

MovingVector operator+(const MovingVector& a, const MovingVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

WamMotion joints(const SwingAngles& swing, const BaseValue& gamma, const Elbow& elbow) {
  WamMotion wam;
  wam.q << swing.q[0], gamma.q, elbow.q3.q, elbow.q4.q;
  wam.qd << swing.qd[0], gamma.qd, elbow.q3.qd, elbow.q4.qd;
  wam.qdd << swing.qdd[0], gamma.qdd, elbow.q3.qdd, elbow.q4.qdd;
  return wam;
}

Forearm forearmOf(const SwingAngles& swing, const BaseValue& gamma) {
  const BaseValue bend{swing.q[1], swing.qd[1], swing.qdd[1]};
  return {gamma + bend, {swing.q[2], swing.qd[2], swing.qdd[2]}, gamma};
}

}  // namespace

WamMotion wamFromSwing(const SwingAngles& swing, double gamma, int elbow_sign, double q3_near) {
  return wamFromSwing(swing, BaseValue{gamma, 0, 0}, elbow_sign, q3_near);
}

WamMotion wamFromSwing(const SwingAngles& swing,
                       const BaseValue& gamma,
                       int elbow_sign,
                       double q3_near) {
  const Forearm forearm = forearmOf(swing, gamma);
  return joints(swing, gamma, ElbowMap(forearm.direction(), elbow_sign).angles(q3_near));
}

WamDerivatives wamDerivatives(const SwingAngles& swing,
                              const BaseValue& gamma,
                              int elbow_sign,
                              double q3_near) {
  const Forearm forearm = forearmOf(swing, gamma);
  const ElbowMap map(forearm.direction(), elbow_sign);
  WamDerivatives result;
  result.motion = joints(swing, gamma, map.angles(q3_near));
  result.F.setZero();
  result.Fd.setZero();
  result.Fdd.setZero();
  result.F(0, 0) = result.F(1, 3) = 1;
  // gamma moves the frame of the upper arm and, q2 being counted from it, the forearm.
  const MovingVector by[] = {forearm.byPolar(), forearm.byAzimuth(),
                             forearm.byPolar() + forearm.byGamma()};
  for (int k = 0; k < 3; ++k) {
    const Elbow d = map.derivative(by[k]);
    result.F.col(k + 1).tail<2>() << d.q3.q, d.q4.q;
    result.Fd.col(k + 1).tail<2>() << d.q3.qd, d.q4.qd;
    result.Fdd.col(k + 1).tail<2>() << d.q3.qdd, d.q4.qdd;
  }
  return result;
}

}  // namespace fastball::model
