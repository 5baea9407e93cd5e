#pragma once

#include <Eigen/Core>

#include "model/trajectory.h"
#include "planner/held_ball.h"
#include "planner/motion_gradient.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// What must hold at every time of a swing. Drives: joint 1, the two motors of joints 2 and 3, joint 4; |a| + |b| <= 1 is
/// |a + b| <= 1 and |a - b| <= 1, and these have no kink at a peak.
enum SwingLimit {
  kRange1,
  kRange2,
  kRange3,
  kRange4,
  kDriveSpeed1,
  kDriveSpeed2,
  kDriveSpeed3,
  kDriveSpeed4,
  kDriveTorque1,
  kDriveTorque2,
  kDriveTorque3,
  kDriveTorque4,
  kElbow,   ///< |J4| at least the margin
  kColumn,  ///< [m], ball from the arm's column
  kFloor,   ///< [m], ball above the lowest height
  kSwingLimits
};

/// The limits at one time, as numbers that must not be positive: how much of the limit is exceeded, or [rad] or [m] as above.
class SwingLimits {
 public:
  using Values = Eigen::Matrix<double, kSwingLimits, 1>;
  /// Derivatives of one of them.
  struct Gradient {
    MotionGradient motion;
    double roll = 0, flexion = 0;  ///< of the wrist
  };

  SwingLimits(const SwingTask& task, int elbow_sign);
  Values at(const model::ArmMotion& motion, const Eigen::Vector3d& p_TBall) const;
  double at(SwingLimit limit, const model::ArmMotion& motion, const Eigen::Vector3d& p_TBall) const;
  Gradient gradient(SwingLimit limit, const model::ArmMotion& motion, const HeldBall& held) const;
  /// "the torque limit of joint 1"
  static const char* name(SwingLimit limit);

 private:
  double range(int joint, double q) const;
  Eigen::Vector4d torque(const model::ArmMotion& motion) const;
  double columnDistance(const Eigen::Vector3d& p_WBall) const;

  const model::Arm& arm_;
  const SwingSettings& settings_;
  double elbow_sign_;
  Eigen::Vector4d q_low_, q_high_;
  Eigen::Matrix4d speed_share_, torque_share_;  ///< of the drives, by joint speeds and torques
};

}  // namespace fastball::planner
