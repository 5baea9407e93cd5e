#pragma once

#include <array>

#include "hand_server/ball_watch.h"
#include "model/ball_parameters.h"
#include "model/grasp.h"
#include "model/hand.h"

namespace fastball::hand_server {

/// Closes each finger as far as the ball is there, whether it lies in the middle or not and however hard it is: a finger's
/// distance from the hand's axis follows its force,
///     dc/dt = (f - f_planned) / (k tau),   k the ball's stiffness in the planned grasp;
/// one that hardly feels the ball looks for it. No finger goes farther than 15 mm.
class GripSettling {
 public:
  GripSettling() = default;
  /// @param time_constant tau [s].
  GripSettling(const model::GraspGeometry& grasp,
               const model::BallParameters& ball,
               const model::HandParameters& hand,
               double time_constant);

  /// Once a tick of dt [s], by the forces felt [N]. While the fingers still close they only give
  /// way.
  void step(const FingerForces& force, bool closing, double dt);
  /// The fingers of posture q, whose distal phalanges are parallel to z, where the forces want them.
  void apply(model::HandVector& q) const;
  /// The grasp as it has settled: posture and distances; forces, torques and deformations are those
  /// planned.
  model::GraspGeometry settled() const;

 private:
  double proximal_length_ = 1;
  std::array<double, model::kFingers> rate_{};    ///< [m/(N s)]
  std::array<double, model::kFingers> change_{};  ///< c [m]
  model::GraspGeometry grasp_;
};

}  // namespace fastball::hand_server
