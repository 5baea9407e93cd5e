#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/atlas.h"
#include "planner/config.h"
#include "planner/plan.h"
#include "planner/release_prediction.h"
#include "planner/swing_planner.h"
#include "planner/window_planner.h"

namespace fastball::planner {

/// Plans throws. Strategy `paper`: the kinetic chain. The others (seeksWindow()): through a release
/// window where one is within reach, else the kinetic chain with joint 2 and the shortest flight.
/// From an atlas where there is one, else from the stored starts. Answers depend on configuration,
/// request and atlas alone.
class Planner {
 public:
  /// @param departure how the ball leaves the hand; default: elastic, with the configuration's fingers.
  /// @param atlas made for this configuration, or null. Its balls leave elastically.
  explicit Planner(const PlannerConfig& config,
                   PredictDeparture departure = {},
                   std::shared_ptr<const Atlas> atlas = nullptr);
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// A plan that checkLimits() finds inside all limits and whose predicted landing is at the
  /// target's centre (within PlannerConfig::landing_tolerance), or why there is none. The request's
  /// biases are planAimed()'s.
  PlanResult plan(const ThrowRequest& request) const;
  const PlannerConfig& config() const { return config_; }
  const model::Arm& arm() const { return arm_; }

 private:
  /// From the atlas alone, of any kind; nothing if no throw in it leads to one in a few steps.
  std::optional<Plan> fromAtlas(const ThrowRequest& request) const;
  std::vector<ThrowKind> kindsFor(const std::string& strategy) const;
  struct Candidate;
  /// Throws of the atlas seen from the target's azimuth, the most promising first.
  std::vector<Candidate> candidates(const ThrowRequest& request,
                                    const std::vector<ThrowKind>& kinds) const;
  std::optional<Plan> firstOf(std::vector<Candidate> candidates, const ThrowRequest& request) const;
  /// From the atlas, or, where that has throws nearby that do not lead to one, from the stored starts: whatever is of a better
  /// kind comes first.
  std::optional<Plan> ofBestKind(const ThrowRequest& request) const;
  std::optional<Plan> anew(const ThrowRequest& request, ThrowKind kind) const;
  std::optional<Plan> planNear(const ThrowRequest& request, const Candidate& candidate) const;
  PlanResult planAnew(const ThrowRequest& request) const;
  Refusal explain(const ThrowRequest& request, const std::string& obstacle) const;
  /// A place at the target's azimuth, near the target, for which there is a throw: on the way to the target from one that is easier.
  std::optional<Plan> nearestPlan(const ThrowRequest& request, Eigen::Vector3d& place) const;
  /// Distances and heights [m] of places where a throw is likely, nearest to the wanted one first.
  std::vector<Eigen::Vector2d> easierPlaces(const Eigen::Vector2d& wanted) const;
  std::string outOfReach(const ThrowRequest& request,
                         const std::string& place,
                         const std::string& obstacle) const;

  PlannerConfig config_;
  model::Arm arm_;
  ReleasePredictor predictor_;
  WindowPlanner windows_;
  SwingPlanner swings_;
  std::optional<std::string> config_fault_;
  std::shared_ptr<const Atlas> atlas_;
};

}  // namespace fastball::planner
