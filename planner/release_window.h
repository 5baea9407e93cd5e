#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/arm.h"
#include "model/ball_flight.h"
#include "model/trajectory.h"

namespace fastball::planner {

/// A stretch of time in which every moment is a right moment to let go: whenever the ball leaves, with the hand's velocity, it
/// comes to the same point P. Let v(p, T) be the velocity with which a ball at p is at P after the time T. Then the ball
/// point of the hand moves by
///     dp/dt = v(p, T),  dT/dt = -1 + u(t).
/// With u = 0 that is the free ball's own flight, and the hand does not push it. With u > 0 the hand loses ground to the ball,
/// with u < 0 it pushes, along the direction in which a change of speed does not change where the ball comes to.
///
/// Joints 1, 2 and 4 follow that path, joint 3 is free: q3 = q3(0) + rate t + acceleration t^2/2 + jerk t^3/6.
struct ReleaseWindow {
  Eigen::Vector4d q_start = Eigen::Vector4d::Zero();  ///< [rad], at its begin, t = 0
  double time_to_go = 0;                              ///< [s], T at t = 0
  Eigen::Vector3d joint3 = Eigen::Vector3d::Zero();   ///< rate, acceleration, jerk [rad/s^1..3]
  Eigen::Vector2d pace = Eigen::Vector2d::Zero();     ///< u at begin and end, linear between
  double length = 0;                                  ///< [s]
};

/// What surrounds a window: the ball's flight and where it shall come to.
struct WindowTask {
  const model::Arm* arm = nullptr;
  Eigen::Vector3d p_TBall = Eigen::Vector3d::Zero();  ///< [m], ball centre in the grasp
  Eigen::Vector3d p_WGoal = Eigen::Vector3d::Zero();  ///< [m], P
  double drag_per_metre = 0;                          ///< [1/m]
  double gravity = 0;                                 ///< [m/s^2]
};

/// The window at the times 0, h, ... length.
struct WindowMotion {
  std::vector<model::ArmMotion> samples;
  std::vector<model::BallState> ball;  ///< of the ball in the hand
  double time_to_go = 0;               ///< [s], at the end
  double residual = 0;                 ///< [m/s^2], largest |hand - free ball| acceleration
};

/// The parameters of a window, in this order: q_start (4), time_to_go, joint3 (3), pace (2).
inline constexpr int kWindowParameters = 10;
/// Of them, where time_to_go and the two paces stand.
inline constexpr int kTimeToGo = 4, kPace = 8;
using ByWindow = Eigen::Matrix<double, 3 * model::kArmJoints, kWindowParameters>;

/// Derivatives of WindowMotion.
struct WindowSlopes {
  std::vector<ByWindow> samples;  ///< rows: q, qd, qdd
  std::vector<Eigen::Matrix<double, 3, kWindowParameters>> v_WBall;
  Eigen::Matrix<double, 1, kWindowParameters> time_to_go =
      Eigen::Matrix<double, 1, kWindowParameters>::Zero();  ///< at the end
};

/// The path by Runge-Kutta 4, the joints on it by Newton's method.
/// @param steps at least 1, of equal length h.
/// @param slopes null if not wanted.
/// @return false if the arm cannot follow: out of reach, its Jacobian of joints 1, 2, 4 singular,
/// or less than 10 ms to go.
bool windowMotion(const WindowTask& task,
                  const ReleaseWindow& window,
                  int steps,
                  WindowMotion& motion,
                  WindowSlopes* slopes = nullptr);

}  // namespace fastball::planner
