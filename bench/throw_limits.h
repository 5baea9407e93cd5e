#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/arm.h"
#include "model/arm_derivatives.h"
#include "model/ball_flight.h"
#include "model/trajectory.h"

namespace fastball::bench {

/// One throw whose joints may move as they like, and what bounds it.
struct FreeThrow {
  const model::Arm* arm = nullptr;
  Eigen::Vector3d p_TBall = Eigen::Vector3d::Zero();  ///< [m], ball centre in the grasp
  double drag_per_metre = 0;                          ///< [1/m]
  double body_clearance = 0;  ///< [m], ball centre from the column's axis, at least
  double lowest_ball = 0;     ///< [m], world z of the ball centre, at least
  /// The ball shall come through its centre, from the front; nothing: anywhere.
  std::optional<model::Target> target;
  bool hold_shoulder = false;   ///< joint 2 stands still
  bool across_forearm = false;  ///< Eq. (25): the ball leaves across the forearm
  double speed_share = 1;       ///< of the arm's speed limits
  double torque_share = 1;      ///< of the arm's torque limits
};

/// The limits in one moment as rows that hold where <= 0. Ranges in rad, speed and torque as shares of
/// their limits less 1, clearances in m. Without a differential the rows of the pair are joint 2's and
/// joint 3's own.
struct LimitRows {
  static constexpr int kRange = 0;  ///< 2 a joint: below, above
  static constexpr int kSpeed = 8;  ///< joint 1 backward, forward; joint 4; the pair (2, 3)
  static constexpr int kTorque = 16;
  static constexpr int kColumn = 24, kFloor = 25;
  static constexpr int kCount = 26;
  Eigen::Matrix<double, kCount, 1> value;
};
/// The same with derivatives by position, speed and acceleration.
struct LimitSlopes {
  LimitRows rows;
  Eigen::Matrix<double, LimitRows::kCount, model::kArmJoints> by_q, by_qd, by_qdd;
};

/// "range of joint 1", "speed of joint 4", "torque of joints 2 and 3", ...
std::string limitName(int row, bool differential);

/// As the arm has them.
LimitRows limitRows(const FreeThrow& task, const model::ArmMotion& motion);
/// With friction from above: its step where a joint turns round is wider and lies ahead, because an optimiser
/// that looks at single moments would trip over the arm's own. What keeps these limits keeps the arm's.
LimitSlopes limitSlopes(const FreeThrow& task, const model::ArmMotion& motion);

/// A release at (q, qd) with flight time T: what the throw asks of it, with derivatives by (q, qd, T).
struct ReleaseRows {
  static constexpr int kBy = 2 * model::kArmJoints + 1;
  using Gradient = Eigen::Matrix<double, 1, kBy>;
  model::BallState ball;
  double speed = 0;  ///< [m/s]
  Gradient speed_slope;
  /// 0 in a throw. Of the ball at the flight's end: its place less the target's centre [m]. At the release:
  /// velocity along the forearm [m/s].
  Eigen::Vector4d equal = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, kBy> equal_slope;
  /// <= 0: how much too flat the ball comes through the ring from its front, planner::kLeastSteepness [10 m/s].
  double grazing = 0;
  Gradient grazing_slope;
};
ReleaseRows releaseRows(const FreeThrow& task,
                        const Eigen::Vector4d& q,
                        const Eigen::Vector4d& qd,
                        double flight_time);

/// Which of ReleaseRows::equal the throw asks for: `count` from `first` on.
struct EqualRows {
  int first, count;
};
EqualRows equalRows(const FreeThrow& task);

}  // namespace fastball::bench
