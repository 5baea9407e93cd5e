#pragma once

#include <cstdint>

#include "hand_server/config.h"
#include "model/ball_parameters.h"
#include "model/grasp.h"
#include "model/trajectory.h"

namespace fastball::hand_server {

/// What the hand must know of a plan; times in seconds from its start.
struct HandPlan {
  int64_t id = 0;
  double t_swing = 0;                                 ///< swing begins
  double t_release_command = 0;                       ///< the hand is told to let go
  double t_release = 0;                               ///< the ball is predicted to leave
  double window = 0;                                  ///< length of the release window
  double grip_force = 0;                              ///< [N], thumb normal force through the swing
  Eigen::Vector2d q_wrist = Eigen::Vector2d::Zero();  ///< [rad], roll and flexion through the swing
  model::SampledTrajectory arm;
  bool adapts =
      false;  ///< the command may come earlier or later by what the hand has learned of its delay
};

/// The same to the last digit.
bool operator==(const HandPlan& a, const HandPlan& b);

/// A plan with the posture that holds the ball.
struct PlannedGrasp {
  HandPlan plan;
  model::GraspGeometry geometry;
  model::HandVector q = model::HandVector::Zero();    ///< [rad], of all joints
  model::HandVector tau = model::HandVector::Zero();  ///< [N m], that presses with the grip force
};

/// @throw std::invalid_argument with one sentence if the hand cannot do what the plan asks: no grip force, one that the
///   ball or the drives cannot bear, a wrist angle beyond its limit, a release outside the plan.
PlannedGrasp planGrasp(const HandPlan& plan,
                       const model::Hand& hand,
                       const model::BallParameters& ball);

}  // namespace fastball::hand_server
