#pragma once

#include <Eigen/Core>

#include "model/trajectory.h"
#include "planner/held_ball.h"
#include "planner/motion_gradient.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// Row i: what drive i does, as a share of its limit, by what the joints do. Drives: joint 1, the
/// two motors of joints 2 and 3, joint 4. With a differential |a| + |b| <= 1 is |a + b| <= 1 and
/// |a - b| <= 1, and these have no kink at a peak.
/// @param limit of each joint alone: speeds [rad/s] or torques [N m].
Eigen::Matrix4d driveShares(const Eigen::Vector4d& limit, bool differential);

/// What must hold at every time of a swing; the drives as driveShares() has them.
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
  kElbow,   ///< [rad], J4 from zero on the side of its elbow sign, at least the margin
  kColumn,  ///< [m], ball from the arm's column
  kFloor,   ///< [m], ball above the lowest height
  kSwingLimits
};

/// The limits at one time, as numbers that must not be positive: the share of the limit that is
/// exceeded (of a range: of its half), or [rad] or [m] as above. Does not allocate or throw.
class SwingLimits {
 public:
  using Values = Eigen::Matrix<double, kSwingLimits, 1>;
  /// Derivatives of one of them.
  struct Gradient {
    MotionGradient motion;
    double roll = 0, flexion = 0;  ///< of the wrist
  };

  /// @param task must outlive the limits, and so must its arm.
  /// @param elbow_sign +1: J4 > 0, -1: J4 < 0.
  SwingLimits(const SwingTask& task, int elbow_sign);
  /// @param p_TBall [m], ball centre in the tool frame.
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
