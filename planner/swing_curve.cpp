#include "planner/swing_curve.h"

#include <algorithm>

namespace fastball::planner {

const std::array<const char*, kSwingVariables>& swingVariableNames() {
  static const std::array<const char*, kSwingVariables> names{
      "alpha1", "omega1", "phi1",   "c1",   "amplitude2", "omega2", "t_switch2",
      "c2",     "alpha3", "omega3", "phi3", "c3",         "gamma",  "flight_time"};
  return names;
}

SwingCurve::SwingCurve(const SwingVector& x, int elbow_sign)
    : upper_arm_(model::SinBase{x[kAlpha1], x[kOmega1], x[kPhi1], x[kC1]}),
      bend_(model::ExpBase{x[kAmplitude2], x[kOmega2], x[kSwitch2], x[kC2]}),
      forearm_(model::SinBase{x[kAlpha3], x[kOmega3], x[kPhi3], x[kC3]}),
      gamma_(x[kGamma]),
      elbow_sign_(elbow_sign) {}

double SwingCurve::begin() const {
  return std::min({upper_arm_.begin(), bend_.begin(), forearm_.begin()});
}

model::ArmMotion SwingCurve::at(double t, double q3_near) const {
  const std::array<model::BaseValue, 3> values{upper_arm_.at(t), bend_.at(t), forearm_.at(t)};
  model::SwingAngles angles;
  for (int i = 0; i < 3; ++i) {
    angles.q[i] = values[i].q;
    angles.qd[i] = values[i].qd;
    angles.qdd[i] = values[i].qdd;
  }
  const model::WamMotion wam = model::wamFromSwing(angles, gamma_, elbow_sign_, q3_near);
  return {wam.q, wam.qd, wam.qdd};
}

}  // namespace fastball::planner
