#pragma once

#include <array>

#include <Eigen/Core>

#include "model/swing.h"
#include "model/trajectory.h"
#include "planner/base_curve.h"

namespace fastball::planner {

/// Decision variables of Eq. (15). Time is counted from the release (t = 0): a common shift of all phases is no freedom.
enum SwingVariable {
  kAlpha1,
  kOmega1,
  kPhi1,
  kC1,  ///< azimuth of the upper arm, sin
  kAmplitude2,
  kOmega2,
  kSwitch2,
  kC2,  ///< polar angle of the forearm past gamma, exp; Eq. (8)'s alpha2 e^phi2 is one
  kAlpha3,
  kOmega3,
  kPhi3,
  kC3,          ///< azimuth of the forearm past the upper arm's, sin
  kGamma,       ///< polar angle of the upper arm
  kFlightTime,  ///< [s], release to target plane
  kSwingVariables
};
using SwingVector = Eigen::Matrix<double, kSwingVariables, 1>;

/// Names of the variables as SWING_PLAN carries them.
const std::array<const char*, kSwingVariables>& swingVariableNames();

/// The motion that Eq. (12) with parameters x makes in WAM joints, from rest to the end of its base functions.
class SwingCurve {
 public:
  /// @param elbow_sign +1: J4 > 0, -1: J4 < 0.
  SwingCurve(const SwingVector& x, int elbow_sign);
  /// [s] (negative), the arm rests before.
  double begin() const;
  /// @param q3_near J3 is the angle (of those 2 pi apart) next to this one.
  model::ArmMotion at(double t, double q3_near = 0) const;

 private:
  SinCurve upper_arm_;
  ExpCurve bend_;
  SinCurve forearm_;
  double gamma_;
  int elbow_sign_;
};

}  // namespace fastball::planner
