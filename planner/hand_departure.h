#pragma once

#include <optional>

#include "model/arm.h"
#include "model/hand.h"
#include "planner/release_prediction.h"

namespace fastball::planner {

/// How a ball leaves a hand, as the hand sees it. It hardly changes from one throw to the next of its kind: known for one, the
/// next needs no integration of the contact.
struct HandDeparture {
  double delay = 0;  ///< [s], from the command to the last touch
  /// Of the free ball at kTime, less that of the grasped ball's nominal place; in the hand frame.
  Eigen::Vector3d p_H = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_H = Eigen::Vector3d::Zero();  ///< [m/s]
  /// [s] after the command: the same for all throws, so that departures can be interpolated. A ball that leaves earlier or later
  /// has its flight at this time all the same.
  static constexpr double kTime = 0.01;
};

/// What the hand sees of a predicted departure.
HandDeparture seenFromHand(const PlannerConfig& config,
                           const model::Arm& arm,
                           const WholeMotion& motion,
                           const ReleasePrediction& prediction);

/// The throw of a motion whose ball leaves the hand like that; nothing if it does not reach the
/// target's plane.
/// @param t_command [s], time of the motion.
std::optional<ReleasePrediction> predictByDeparture(const PlannerConfig& config,
                                                    const model::Arm& arm,
                                                    const HandDeparture& departure,
                                                    const WholeMotion& motion,
                                                    const WristAngles& wrist,
                                                    const model::Target& target,
                                                    double t_command);

}  // namespace fastball::planner
