#pragma once

#include <Eigen/Core>

#include "model/hand.h"
#include "planner/release_window.h"
#include "planner/swing_task.h"

namespace fastball::planner {

/// [s], either side of a window, in which each joint's acceleration goes linearly from its value in the window to another one:
/// speeds that are at their limits in the window are then not far above them before it.
inline constexpr double kWindowRamp = 0.01;

/// A throw through a release window, from rest to rest: each joint runs up by a quartic of its own and a ramp, goes through the
/// window, and after another ramp is braked by a quartic. t = 0 is the window's begin.
struct WindowThrow {
  ReleaseWindow window;
  Eigen::Vector4d run_up = Eigen::Vector4d::Zero();      ///< [s], before the ramp
  Eigen::Vector4d brake = Eigen::Vector4d::Zero();       ///< [s], after the ramp
  Eigen::Vector4d qdd_before = Eigen::Vector4d::Zero();  ///< [rad/s^2], where the first ramp begins
  Eigen::Vector4d qdd_after = Eigen::Vector4d::Zero();   ///< [rad/s^2], where the second ramp ends
};

/// Decision variables of a WindowThrow of given length, in order: q_start (4), time_to_go, joint3 (3), pace (2), run_up (4),
/// brake (4), qdd_before (4), qdd_after (4).
inline constexpr int kWindowVariables = 26;
using WindowVector = Eigen::Matrix<double, kWindowVariables, 1>;
WindowVector toVector(const WindowThrow& x);
WindowThrow fromVector(const WindowVector& x, double length);

/// Errors that a throw meets, as standard deviations: among the throws inside the limits the solver takes the one whose landing
/// they move least.
struct ThrowErrors {
  double joint_speed = 0;  ///< [rad/s], of each joint at the release
  double grasp = 0;        ///< [m], of the ball's place in the hand, per axis
  double drag = 0;         ///< share of the drag
};

/// What a window throw must keep and what it shall be good at.
struct WindowProblem {
  WindowTask task;
  const model::Hand* hand = nullptr;
  SwingSettings settings;
  Eigen::Vector3d n_WTarget = -Eigen::Vector3d::UnitX();
  double wanted_speed = 0;  ///< [m/s], at the window's begin: less costs
  ThrowErrors errors;
  double limit_factor = 1;   ///< the share of speed and torque limits that may be used
  double length = 0;         ///< [s], of the window
  bool free_flight = false;  ///< pace held at zero: the window is the ball's own flight
  /// Nearness to this throw counts `nearness` times the squared distance (in variables over their sizes).
  WindowVector near = WindowVector::Zero();
  double nearness = 0;
};

/// A solved throw.
struct WindowSolution {
  WindowThrow x;
  bool feasible = false;  ///< inside all limits at the samples
  double violation = 0;   ///< of the limits, largest, as a share of them
  double cost = 0;        ///< sum of squares, limits included
  double residual = 0;    ///< [m/s^2], largest |hand - free ball| acceleration in the window
};

/// Least squares from `start` by Levenberg-Marquardt.
WindowSolution solveWindowThrow(const WindowProblem& problem,
                                const WindowThrow& start,
                                int max_evaluations);

/// The first throw inside the limits on the way of that optimisation: one near `start`, if the limits are not far.
WindowSolution correctWindowThrow(const WindowProblem& problem,
                                  const WindowThrow& start,
                                  int max_evaluations);

/// What x is worth, without a step.
WindowSolution assessWindowThrow(const WindowProblem& problem, const WindowThrow& x);

}  // namespace fastball::planner
