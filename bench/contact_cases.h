#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "config/experiment.h"
#include "model/ball_parameters.h"
#include "model/trajectory.h"

namespace fastball::bench {

/// A motion of the arm [rad, s] by cubics: the same for simulator and reference.
struct CubicMotion {
  Eigen::Vector4d q, qd, qdd, qddd;  ///< at t = 0
  model::ArmMotion at(double t) const;
};

/// A ball on the fingers of a hand that is moved without regard to forces.
struct ContactCase {
  std::string name;
  model::BallParameters ball;
  /// true: in the groove of fingers A and B; false: on finger A alone straight behind the ball, where it rolls as on a plane.
  bool groove = true;
  CubicMotion motion;
  double duration = 0.15;  ///< [s]
};

/// Swings with gravity in the plane of the motion or all joints moving, which push the ball less and less until it leaves;
/// E from 2e4 to 1e7 Pa, damped as in the experiment and not at all, a light ball and a heavy one.
std::vector<ContactCase> contactCases(const config::Experiment& experiment);

}  // namespace fastball::bench
