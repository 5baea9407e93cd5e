#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/experiment.h"
#include "hand_server/config.h"
#include "hand_server/hand_controller.h"
#include "hand_server/hand_plan.h"
#include "model/arm.h"
#include "planner/planner.h"
#include "sim_bullet/scene.h"

namespace fastball::bench {

/// A throw as the hand felt it, and as it was; times in seconds from the command to let go.
struct FeltThrow {
  sim_bullet::SceneErrors errors;        ///< what was drawn for it
  double departure = 0;                  ///< true: the last finger has left the ball
  std::optional<double> felt_departure;  ///< as RELEASE says it
  double planned_departure = 0;          ///< as the plan says
  double predicted_departure = 0;  ///< as the hand says that has learned from the throws before
  hand_server::GripEstimate lay;   ///< true, when the swing began
  std::optional<hand_server::GripEstimate> felt_lay;
  std::optional<hand_server::DeadTimes> felt_dead_times;  ///< if the plan adapts
  double last_touch = 0;                                  ///< of the last state that feels the ball
};

/// Throws of the default experiment from the grasp to the departure, with the hand server's fingers and the simulator's sensors.
/// The arm waits where the swing begins and swings as soon as the ball is held, so that a throw is short.
class FeltThrows {
 public:
  /// @param strategy of the planner; it decides how the hand lets go (hand_server.release_mode).
  /// @throw std::runtime_error if there is no plan.
  FeltThrows(const std::string& experiment_path, const std::string& strategy);

  /// One throw with errors drawn from the seed, thrown by `hand`, which may have thrown before.
  /// @throw std::runtime_error if the ball does not leave the hand.
  FeltThrow run(hand_server::HandController& hand,
                const sim_bullet::Uncertainty& uncertainty,
                int64_t seed) const;
  /// A hand that has not thrown yet.
  hand_server::HandController makeHand() const;
  model::ReleaseMode releaseMode() const { return hand_config_.release.modeFor(plan_.window); }

 private:
  Eigen::Vector4d armTorque(const sim_bullet::RobotState& robot, double t) const;

  config::Experiment experiment_;
  sim_bullet::SimulationSettings simulation_;
  hand_server::HandServerConfig hand_config_;
  model::Arm arm_;
  model::Hand fingers_;
  hand_server::HandPlan plan_;
  long start_tick_;  ///< of a scene, t = 0 of the plan
  Eigen::Isometry3d X_TH_;
};

/// A ball of another stiffness, friction, mass and place in the hand in every throw. The
/// fingers obey without dead time: a thumb that opens late grazes the ball that has been let go with less than the sensors feel.
sim_bullet::Uncertainty unknownBall();

/// Root mean squares [s] over throws.
struct DepartureError {
  double felt = 0;        ///< of the departure that RELEASE says
  double last_touch = 0;  ///< if the last state that feels the ball were taken for it
  int missed = 0;         ///< throws whose departure was not felt
};

/// Of throws with the seeds 1 to `count`.
/// @throw std::runtime_error if a ball does not leave the hand.
DepartureError departureError(const FeltThrows& throws,
                              const sim_bullet::Uncertainty& uncertainty,
                              int count);

}  // namespace fastball::bench
