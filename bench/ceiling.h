#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/throw_check.h"
#include "model/ball_flight.h"
#include "model/target.h"
#include "model/trajectory.h"
#include "planner/config.h"

namespace fastball::bench {

/// Which throws compete.
struct CeilingOptions {
  bool hold_shoulder = false;   ///< joint 2 stands still, where it likes
  bool across_forearm = false;  ///< the ball leaves across the forearm, Eq. (25)
  bool must_land = true;        ///< false: wherever the ball goes
  double torque_share = 1;      ///< of the arm's torque limits, in (0, 1]
  double speed_share = 1;       ///< of the arm's speed limits, in (0, 1]
  int control_points = 12;      ///< of each joint's curve, 6 to 40
  int starts = 8;               ///< optimisations at most, 1 to 1000
  bool all_starts = false;      ///< false: none after the one that reaches the bound
  int64_t seed = 1;
};

/// A throw whose joints move as they like from rest to rest.
struct Ceiling {
  bool found = false;
  double release_speed = 0;  ///< [m/s], of the ball's centre
  /// [m/s], of the fastest release in ranges, speed limits and clearances alone: no throw is faster.
  /// 0 if there is none, or if it was not asked for.
  double bound = 0;
  ThrowCheck check;          ///< its violation is at most 1e-6
  int starts = 0;            ///< optimisations made
  int starts_near_best = 0;  ///< of them came to 0.5 % of the best of them
  model::SampledTrajectory trajectory;
  double t_release = 0;  ///< [s], time of the trajectory
};

/// The fastest throw through the centre of `target` from its front, under the limits that the
/// planner's configuration sets, with its arm, hand and ball.
/// @throw std::invalid_argument if an option or the target makes no sense.
Ceiling ceiling(const planner::PlannerConfig& config,
                const model::Target& target,
                const CeilingOptions& options = {});

/// Some throw through the centre of `target`: the first that is found in `starts` optimisations. Much
/// cheaper than the fastest.
Ceiling anyThrow(const planner::PlannerConfig& config,
                 const model::Target& target,
                 const CeilingOptions& options = {});
/// Whether there is one.
bool reachable(const planner::PlannerConfig& config,
               const model::Target& target,
               const CeilingOptions& options = {});

/// The ceiling for each of the shares of the torque limits, in their order; `options.torque_share` is
/// not used. Each is at least as high as that of the shares below it.
std::vector<Ceiling> ceilingOverTorqueBudget(const planner::PlannerConfig& config,
                                             const model::Target& target,
                                             const CeilingOptions& options,
                                             const std::vector<double>& torque_shares);

/// The throws that `options` let compete. @param arm lives as long as they.
FreeThrow freeThrow(const planner::PlannerConfig& config,
                    const model::Arm& arm,
                    const model::Target& target,
                    const CeilingOptions& options);

}  // namespace fastball::bench
