#pragma once

#include <functional>
#include <optional>

#include "model/arm.h"
#include "model/hand.h"
#include "model/release.h"
#include "planner/config.h"
#include "planner/hand_motion.h"
#include "planner/whole_motion.h"

namespace fastball::planner {

/// How a ball leaves a moving hand after the command at time 0.
/// @param hand_at(t) the hand's motion; @param support what gives way under it; @param mode of the release.
using PredictDeparture =
    std::function<model::Departure(const std::function<model::HandMotion(double)>& hand_at,
                                   const model::HandSupport& support,
                                   model::ReleaseMode mode)>;

/// model::predictDeparture with the fingers of the configuration.
PredictDeparture elasticDeparture(const PlannerConfig& config);
/// A ball that is free at the command, with the hand's velocity.
PredictDeparture instantDeparture(const PlannerConfig& config);

/// What becomes of the ball in a motion.
struct ReleasePrediction {
  double t_command = 0;    ///< [s], time of the motion
  double t_departure = 0;  ///< [s], time of the motion
  WristAngles wrist;
  model::BallState ball;  ///< at the departure
  model::Landing landing;
};

/// Predicts the throw that a motion makes, for one configuration.
class ReleasePredictor {
 public:
  /// @param config, arm must outlive this.
  ReleasePredictor(const PlannerConfig& config, const model::Arm& arm, PredictDeparture departure);

  /// The throw when the hand is told to let go at t_command [s], time of the motion; nothing if the
  /// swing loses the ball before, the ball does not leave, the hand touches it again within 150 ms,
  /// or it does not reach the plane.
  std::optional<ReleasePrediction> predict(const WholeMotion& motion,
                                           const WristAngles& wrist,
                                           const model::Target& target,
                                           double t_command) const;
  /// The same with the wrist so that Eq. (25) holds at the swing's t = 0.
  std::optional<ReleasePrediction> predict(const WholeMotion& motion,
                                           const model::Target& target,
                                           double t_command) const;
  /// The whole millisecond [s], time of the motion, at which to let go: an abrupt thumb begins to
  /// move when Eq. (24) comes true near the swing's t = 0, slower modes begin as much earlier as
  /// they take longer.
  double commandTime(const WholeMotion& motion) const;
  /// The same in a release window: so that the ball leaves in its middle.
  double windowCommandTime(const WholeMotion& motion) const;
  /// Largest |acceleration of the hand's ball point - that of a free ball| [m/s^2] at eleven times
  /// between two [s].
  double residualAcceleration(const model::SampledTrajectory& trajectory,
                              const WristAngles& wrist,
                              double from,
                              double to) const;

 private:
  WristAngles wristAngles(const WholeMotion& motion) const;

  const PlannerConfig& config_;
  const model::Arm& arm_;
  model::Hand hand_;
  PredictDeparture departure_;
};

}  // namespace fastball::planner
