#pragma once

#include <Eigen/Core>
#include <bitset>

#include "model/arm.h"
#include "model/ball_parameters.h"
#include "model/hand.h"
#include "model/target.h"
#include "planner/follow_through.h"
#include "planner/plan.h"

namespace fastball::planner {

/// What the polar angle of the upper arm does in the swing.
enum class Shoulder {
  kHeld,  ///< nothing, as in the analogous swing model
  kFree,  ///< it follows a sin base function of its own
};

/// Which of the swings that hit is wanted.
enum class SwingGoal {
  kFastest,        ///< Eq. (15): greatest speed of the hand
  kShortestFlight  ///< errors of drag and velocity have the least time to grow
};

/// How a swing is bounded besides by the arm's own limits.
struct SwingSettings {
  Shoulder shoulder = Shoulder::kHeld;
  Eigen::Vector3d omega_max =
      Eigen::Vector3d::Zero();  ///< [rad/s, 1/s, rad/s], of the base functions
  double elbow_margin =
      0;  ///< [rad], |J4| at least, in the swing: the map from the swing model is singular at 0
  double body_clearance =
      0;  ///< [m], ball centre from the axis of the column that carries the shoulder, at least
  double lowest_ball = 0;    ///< [m], world z of the ball centre, at least
  double flexion_limit = 0;  ///< [rad], |flexion| of the wrist at most
  FollowThrough follow;
};

/// One throw to be optimised by Eq. (15); `arm` and `hand` must outlive it.
struct SwingTask {
  const model::Arm* arm = nullptr;
  const model::Hand* hand = nullptr;
  model::BallParameters ball;
  model::Target target;
  Eigen::Vector2d aim = Eigen::Vector2d::Zero();  ///< [m], plane coordinates of the landing
  SwingSettings settings;
  SwingGoal goal = SwingGoal::kFastest;
  double limit_factor = 1;  ///< the share of speed and torque limits that may be used
  /// Sine of the angle at which the ball comes through the ring, at least: what is asked, and a
  /// little for what the fingers change.
  double steepness = kLeastSteepness + 0.005;
  bool must_land = true;  ///< false: fastest throw of all, wherever it goes
  double grid_density =
      1;  ///< times as many grid points as usual, on which the peaks of the limits are looked for
  std::bitset<32> fixed;  ///< variables (SwingVariable) that keep their value
};

}  // namespace fastball::planner
