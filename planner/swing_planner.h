#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "planner/atlas.h"
#include "planner/config.h"
#include "planner/plan.h"
#include "planner/release_prediction.h"
#include "planner/starts.h"

namespace fastball::planner {

/// The swing to `target` as the configuration asks for it; `arm` and `hand` must outlive it.
SwingTask swingTask(const PlannerConfig& config,
                    const model::Arm& arm,
                    const model::Hand& hand,
                    const model::Target& target,
                    Shoulder shoulder);

/// Plans throws by the kinetic chain: the base functions of Eq. (12) in the analogous swing model (section 2.6) on the WAM,
/// their parameters by Eq. (15), release by Eqs. (24) and (25).
class SwingPlanner {
 public:
  static constexpr double kApproachPrice =
      0.1;  ///< [m/s per s], what a second of approach is worth

  SwingPlanner(const PlannerConfig& config,
               const model::Arm& arm,
               const ReleasePredictor& predictor);

  /// The best throw found, or what hinders it.
  /// @param shoulders tried one after the other; random starts only with the last.
  PlanResult plan(const ThrowRequest& request,
                  const std::vector<Shoulder>& shoulders,
                  SwingGoal goal = SwingGoal::kFastest) const;

  /// A throw that lies near a known one for a target nearby; nothing if a few steps do not lead to it.
  /// @param near seen from the target's azimuth.
  std::optional<Plan> planNear(const ThrowRequest& request,
                               const AtlasThrow& near,
                               Shoulder shoulder,
                               SwingGoal goal = SwingGoal::kFastest) const;

  /// @param q_arm where the arm rests; nothing: where the swing begins.
  WholeMotion motionOf(const SwingSolution& solution,
                       const std::optional<Eigen::Vector4d>& q_arm) const;
  SwingTask taskFor(const ThrowRequest& request,
                    Shoulder shoulder,
                    SwingGoal goal = SwingGoal::kFastest) const;
  /// The fastest throw of all from the stored starts, wherever it goes.
  SwingSolution fastest(const ThrowRequest& request, Shoulder shoulder) const;

 private:
  /// A swing whose ball is predicted to land where it shall.
  struct Aimed {
    SwingSolution solution;
    WholeMotion motion;
    ReleasePrediction prediction;
  };
  std::variant<Aimed, Refusal> aim(SwingTask task,
                                   SwingSolution solution,
                                   const ThrowRequest& request) const;
  Plan assemble(const Aimed& aimed, const ThrowRequest& request) const;
  /// From the stored starts; if none leads to a throw that keeps all constraints, `thoroughly`: from random ones, and harder.
  std::vector<SwingSolution> search(const SwingTask& task,
                                    const ThrowRequest& request,
                                    bool thoroughly) const;
  std::vector<SwingSolution> solveAll(const SwingTask& task,
                                      const std::vector<Start>& starts) const;
  /// A second try for the solutions that are nearest to keeping all constraints.
  std::vector<SwingSolution> solveHarder(const SwingTask& task,
                                         std::vector<SwingSolution> solutions) const;
  void sortByWorth(SwingGoal goal,
                   std::vector<SwingSolution>& solutions,
                   const ThrowRequest& request) const;
  /// The best of the solutions made into a throw that keeps all limits, or what hinders it.
  std::variant<Aimed, Refusal> realise(SwingTask task,
                                       std::vector<SwingSolution> candidates,
                                       const ThrowRequest& request) const;

  const PlannerConfig& config_;
  const model::Arm& arm_;
  const ReleasePredictor& predictor_;
  model::Hand hand_;
};

}  // namespace fastball::planner
