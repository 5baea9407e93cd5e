#pragma once

#include <Eigen/Core>

#include "launch/figures/figure.h"
#include "model/arm.h"
#include "planner/plan.h"

namespace fastball::launch {

/// The throw that the planner makes for the experiment's own target by the strategy "paper".
/// @throw std::runtime_error with the planner's sentence if it refuses.
planner::Plan planPaperThrow(const FigureTask& task);

/// A parameter of the plan by its name. @throw std::runtime_error if the plan has none of that
/// name.
double parameter(const planner::Plan& plan, const std::string& name);

/// Speeds (dq1, dq2, dq3) [rad/s] of the analogous swing model (section 2.6) that the arm makes: of
/// the azimuth of the upper arm, of the polar angle of the forearm, and of its azimuth past that of
/// the upper arm. Not finite where the forearm is upright.
Eigen::Vector3d swingSpeeds(const model::Arm& arm, const model::ArmMotion& motion);

}  // namespace fastball::launch
