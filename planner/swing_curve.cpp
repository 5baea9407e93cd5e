#include "planner/swing_curve.h"

#include <algorithm>

namespace fastball::planner {
namespace {

BaseCurve sinCurve(const SwingVector& x, int first) {
  return BaseCurve(model::SinBase{x[first], x[first + 1], x[first + 2], x[first + 3]});
}

BaseCurve expCurve(const SwingVector& x, int first) {
  return BaseCurve(model::ExpBase{x[first], x[first + 1], x[first + 2], x[first + 3]});
}

model::SwingAngles anglesOf(const std::array<model::BaseValue, 3>& values) {
  model::SwingAngles angles;
  for (int i = 0; i < 3; ++i) {
    angles.q[i] = values[i].q;
    angles.qd[i] = values[i].qd;
    angles.qdd[i] = values[i].qdd;
  }
  return angles;
}

}  // namespace

const std::array<const char*, kSwingVariables>& swingVariableNames() {
  static const std::array<const char*, kSwingVariables> names{
      "alpha1", "omega1",      "phi1",        "c1",           "amplitude2",
      "omega2", "t_switch2",   "c2",          "alpha3",       "omega3",
      "phi3",   "c3",          "alpha_gamma", "omega_gamma",  "phi_gamma",
      "gamma",  "flight_time", "wrist_roll",  "wrist_flexion"};
  return names;
}

SwingCurve::SwingCurve(const SwingVector& x, int elbow_sign)
    : curves_{sinCurve(x, kAlpha1), expCurve(x, kAmplitude2), sinCurve(x, kAlpha3),
              sinCurve(x, kAlphaGamma)},
      elbow_sign_(elbow_sign),
      held_(x[kAlphaGamma] == 0) {}

double SwingCurve::begin() const {
  const double chain = std::min({curves_[0].begin(), curves_[1].begin(), curves_[2].begin()});
  return held_ ? chain : std::min(chain, curves_[3].begin());
}

model::ArmMotion SwingCurve::at(double t, double q3_near) const {
  const model::SwingAngles angles =
      anglesOf({curves_[0].at(t), curves_[1].at(t), curves_[2].at(t)});
  const model::WamMotion wam = model::wamFromSwing(angles, curves_[3].at(t), elbow_sign_, q3_near);
  return {wam.q, wam.qd, wam.qdd};
}

SwingDerivatives SwingCurve::derivativesAt(double t, double q3_near) const {
  SwingDerivatives d;
  for (int i = 0; i < 4; ++i)
    d.curves[i] = curves_[i].derivativesAt(t);
  d.wam = model::wamDerivatives(anglesOf({d.curves[0].value, d.curves[1].value, d.curves[2].value}),
                                d.curves[3].value, elbow_sign_, q3_near);
  return d;
}

void SwingDerivatives::pull(const MotionGradient& g, SwingVector& gradient) const {
  // To the angles of the swing model, then to the parameters of each.
  const Eigen::Vector4d z =
      wam.F.transpose() * g.q + wam.Fd.transpose() * g.qd + wam.Fdd.transpose() * g.qdd;
  const Eigen::Vector4d zd = wam.F.transpose() * g.qd + 2 * wam.Fd.transpose() * g.qdd;
  const Eigen::Vector4d zdd = wam.F.transpose() * g.qdd;
  for (int i = 0; i < 4; ++i) {
    gradient.segment<4>(4 * i) +=
        z[i] * curves[i].dq + zd[i] * curves[i].dqd + zdd[i] * curves[i].dqdd;
  }
}

}  // namespace fastball::planner
