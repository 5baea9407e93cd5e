#pragma once

#include <Eigen/Core>

#include "controller/plan.h"
#include "model/arm.h"
#include "model/ball_parameters.h"
#include "model/hand.h"

namespace fastball::controller {

/// What a ball that does not lie where the plan has it asks of the arm.
class GripCorrection {
 public:
  GripCorrection(const model::Arm& arm, const model::Hand& hand, const model::BallParameters& ball)
      : arm_(arm), hand_(hand), ball_(ball) {}

  /// The change of posture [rad], held through the swing, by which a ball that lies at p_HBall [m], off its place in the hand,
  /// passes, after the plan's time of flight, through the place of the planned one. Off its place the ball leaves beside the
  /// planned path and with another velocity, dv = w x dp; both are made good across its direction there, to first
  /// order: two equations, of whose solutions this is the smallest. Not finite for a plan that makes no sense.
  Eigen::Vector4d postureChange(const Plan& plan, const Eigen::Vector3d& p_HBall) const;

 private:
  model::Arm arm_;
  model::Hand hand_;
  model::BallParameters ball_;
};

}  // namespace fastball::controller
