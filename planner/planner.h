#pragma once

#include "planner/config.h"
#include "planner/plan.h"
#include "planner/release_prediction.h"

namespace fastball::planner {

/// Plans throws by the kinetic chain: the base functions of Eq. (12) in the analogous swing model (section 2.6) on the WAM,
/// their parameters by Eq. (15), release by Eqs. (24) and (25). Answers depend on the request alone.
class Planner {
 public:
  /// @param departure how the ball leaves the hand; default: elastic, with the configuration's fingers.
  explicit Planner(const PlannerConfig& config, PredictDeparture departure = {});
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// A plan inside all limits on a 1 ms grid whose predicted landing is at the target's centre, or why there is none.
  PlanResult plan(const ThrowRequest& request) const;
  const PlannerConfig& config() const { return config_; }
  const model::Arm& arm() const { return arm_; }

 private:
  struct Aimed;
  SwingTask taskFor(const ThrowRequest& request) const;
  std::vector<SwingSolution> solveAll(const SwingTask& task, const ThrowRequest& request) const;
  /// A second try for the solutions that are nearest to keeping all constraints.
  std::vector<SwingSolution> solveHarder(const SwingTask& task,
                                         std::vector<SwingSolution> solutions) const;
  void sortByWorth(std::vector<SwingSolution>& solutions, const ThrowRequest& request) const;
  std::variant<Aimed, Refusal> aim(SwingTask task,
                                   SwingSolution solution,
                                   const ThrowRequest& request) const;
  Plan assemble(const Aimed& aimed, const ThrowRequest& request) const;
  Refusal explain(const SwingTask& task,
                  const std::vector<SwingSolution>& solutions,
                  const ThrowRequest& request) const;

  PlannerConfig config_;
  model::Arm arm_;
  ReleasePredictor predictor_;
};

}  // namespace fastball::planner
