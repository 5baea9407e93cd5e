#pragma once

#include <Eigen/Core>
#include <array>

#include "model/swing.h"
#include "model/trajectory.h"
#include "planner/base_curve.h"
#include "planner/motion_gradient.h"

namespace fastball::planner {

/// Decision variables of Eq. (15). Time is counted from the release (t = 0): a common shift of all phases is no
/// freedom. The first sixteen are the parameters of four base functions.
/// Angles [rad], omegas [rad/s] (of the exp function [1/s]), the switching time [s].
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
  kC3,  ///< azimuth of the forearm past the upper arm's, sin
  kAlphaGamma,
  kOmegaGamma,
  kPhiGamma,
  kGamma,       ///< polar angle of the upper arm, sin; held if kAlphaGamma is 0
  kFlightTime,  ///< [s], release to target plane
  kWristRoll,
  kWristFlexion,  ///< [rad], of the hand through the swing
  kSwingVariables
};
using SwingVector = Eigen::Matrix<double, kSwingVariables, 1>;

/// Names of the variables as SWING_PLAN carries them.
const std::array<const char*, kSwingVariables>& swingVariableNames();

/// A motion of the arm at one time, and how it depends on the parameters that made it.
struct SwingDerivatives {
  std::array<BaseCurve::Derivatives, 4> curves;  ///< q1, q2, q3, gamma
  model::WamDerivatives wam;

  model::ArmMotion motion() const { return {wam.motion.q, wam.motion.qd, wam.motion.qdd}; }
  /// Adds to `gradient` that of a number whose derivatives by the motion are `g` (the chain rule).
  void pull(const MotionGradient& g, SwingVector& gradient) const;
};

/// The motion that Eq. (12) with parameters x makes in WAM joints, from rest to the end of its base functions.
class SwingCurve {
 public:
  /// @param elbow_sign +1: J4 > 0, -1: J4 < 0.
  SwingCurve(const SwingVector& x, int elbow_sign);
  /// [s] (negative), the arm rests before.
  double begin() const;
  /// At t [s]. @param q3_near [rad]: J3 is the angle (of those 2 pi apart) next to this one.
  model::ArmMotion at(double t, double q3_near = 0) const;
  SwingDerivatives derivativesAt(double t, double q3_near = 0) const;

 private:
  std::array<BaseCurve, 4> curves_;  ///< q1, q2, q3, gamma
  int elbow_sign_;
  bool held_;  ///< gamma does not move
};

}  // namespace fastball::planner
