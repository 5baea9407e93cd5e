#pragma once

#include <optional>
#include <vector>

#include "planner/atlas.h"
#include "planner/config.h"
#include "planner/plan.h"
#include "planner/release_prediction.h"
#include "planner/window_throw.h"

namespace fastball::planner {

/// A length of release windows and the share of the limits that its throws may use.
struct WindowKind {
  double length = 0;       ///< [s]
  double limit_share = 0;  ///< of speed and torque limits, for the optimisation
};

/// Plans throws through a release window: of the throws found, the one whose landing the errors of
/// the configuration move least.
class WindowPlanner {
 public:
  /// Of the optimiser's sum of squares, what a second of approach is worth.
  static constexpr double kApproachPrice = 0.2;

  WindowPlanner(const PlannerConfig& config,
                const model::Arm& arm,
                const ReleasePredictor& predictor);

  /// The best throw through the first kind of window for which there is one inside all limits; nothing if there is none for
  /// any.
  /// @param thoroughly from every stored start; else only from those that look best at first.
  std::optional<Plan> plan(const ThrowRequest& request, bool thoroughly) const;

  /// A throw that lies near a known one for a target nearby; nothing if a few steps do not lead to it.
  /// @param near seen from the target's azimuth.
  std::optional<Plan> planNear(const ThrowRequest& request, const AtlasThrow& near) const;

  WindowProblem problemFor(const ThrowRequest& request, const WindowKind& kind) const;
  /// Nothing if the arm cannot follow. @param q_arm where the arm rests; nothing: where the swing
  /// begins.
  std::optional<WholeMotion> motionOf(const WindowProblem& problem,
                                      const std::optional<Eigen::Vector4d>& q_arm,
                                      const WindowThrow& x) const;
  /// Turns the thumb to where the ball flies and, as far as the hand falls behind it, to where it
  /// drifts in the hand, both in the window's middle; no flexion.
  WristAngles wristOf(const WholeMotion& motion) const;

 private:
  /// A solution aimed so that the ball, as the fingers let it go, lands at the target's centre.
  struct Settled {
    WindowThrow x;
    WholeMotion motion;
    ReleasePrediction prediction;
  };
  /// The best throw for a kind of window.
  std::optional<WindowSolution> solve(const ThrowRequest& request,
                                      const WindowKind& kind,
                                      bool thoroughly) const;
  /// The best throw near one start; nothing outside the limits.
  std::optional<WindowSolution> solveFrom(const ThrowRequest& request,
                                          const WindowKind& kind,
                                          const WindowThrow& start,
                                          int max_evaluations) const;
  /// Nothing if it does not settle inside all limits.
  std::optional<Settled> settle(const ThrowRequest& request,
                                const WindowKind& kind,
                                const WindowThrow& x) const;
  Plan assemble(const ThrowRequest& request, const Settled& settled) const;
  WindowKind kindOf(double length) const;
  bool landsRight(const ReleasePrediction& prediction) const;

  const PlannerConfig& config_;
  const model::Arm& arm_;
  model::Arm
      cautious_arm_;  ///< with more room to its stops, for what happens between the optimiser's samples
  model::Hand hand_;
  const ReleasePredictor& predictor_;
  std::vector<WindowKind> kinds_;  ///< in the order in which they are tried
};

}  // namespace fastball::planner
