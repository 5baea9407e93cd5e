#pragma once

#include <Eigen/Core>
#include <vector>

#include "config/experiment.h"
#include "model/elastic_ball.h"
#include "model/release.h"
#include "model/target.h"
#include "planner/config.h"
#include "planner/plan.h"

namespace fastball::launch {

/// The hand of a planned throw about the moment at which Eq. (24) comes true, which is t = 0 here.
struct PlannedRelease {
  config::Experiment experiment;
  model::ReleaseCommand command;
  model::HandPath hand_at;  ///< good from 0.1 s before to 0.1 s after
  double t_plan = 0;        ///< [s], of the plan
  model::FingerPair fingers;
  double fingertip = 0;  ///< [m], x' at which the ball comes to the fingers' ends
};
/// @throw std::runtime_error if the hand pushes all the time about the planned release, or never does.
PlannedRelease plannedRelease(const config::Experiment& experiment,
                              const planner::PlannerConfig& config,
                              const planner::Plan& plan);

/// How a ball comes off when something is late or early by `error` [s].
enum class LetGo {
  kFreely,   ///< all fingers are gone at once at the error: the ball has the hand's velocity
  kRolling,  ///< the thumb is gone at the error; the rigid ball rolls and slips on the two fingers until they stop pushing
  kPrinted,  ///< the same by the paper's Eqs. (21) and (22): 5/7, no slip
  kElastic,  ///< the thumb is told to open at the error and squeezes until then; the elastic ball
  kGently,  ///< the thumb's force has faded out at the error; the elastic ball rests on the two fingers then
  /// The ball comes off the fingers late by the error and has rolled on them since t = 0, by Eq. (21) near the release, ddx' =
  /// 5/7 (-alpha0x' + gx'): Fig. 9.
  kLongerOnFingers,
};

/// Where the ball lands, in the target's plane [m]: to the right and up.
/// @throw std::runtime_error if it does not leave or does not come to the plane.
Eigen::Vector2d landing(const PlannedRelease& release, LetGo how, double error);

/// The rigid ball, the thumb gone at the error [s]; on fingers without ends if so wanted.
model::RollingMotion rigidRoll(const PlannedRelease& release, double error, bool endless);

/// Landing against error: slope [m/s], to the right and up, by least squares over `errors` [s].
/// @throw std::runtime_error as landing(); std::invalid_argument unless there are two different
///   errors.
Eigen::Vector2d landingShift(const PlannedRelease& release,
                             LetGo how,
                             const std::vector<double>& errors);

}  // namespace fastball::launch
