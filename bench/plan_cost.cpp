#include "bench/plan_cost.h"

#include <algorithm>
#include <ctime>
#include <functional>

#include "bench/dense_swing.h"
#include "config/experiment.h"
#include "planner/config.h"
#include "planner/starts.h"
#include "planner/swing_planner.h"

namespace fastball::bench {
namespace {

using planner::Shoulder;
using planner::Start;
using planner::SwingSolution;
using planner::SwingTask;

constexpr double kSolved = 1e-3;  // violation up to which a solution counts
constexpr double kPlainDensity =
    4;  // the plain way needs samples so dense to hold the limits to 1e-4

/// The default experiment's throw.
struct DefaultSwing {
  std::string path = config::defaultExperimentPath();
  config::Experiment experiment = config::loadExperiment(path);
  planner::PlannerConfig config = planner::loadConfig(path);
  model::Arm arm{config.arm, config.hand.payload};
  model::Hand hand{config.hand};

  SwingTask task(Shoulder shoulder) const {
    return planner::swingTask(config, arm, hand, experiment.target, shoulder);
  }
};

int parametersOf(const SwingTask& task) {
  const planner::SwingProblem problem(task, 1);
  int count = 0;
  for (int i = 0; i < planner::kSwingVariables; ++i)
    count += problem.isFree(i);
  return count;
}

/// Grid points of the planner within the motion that a solution makes.
int samplesOf(const SwingTask& task, const SwingSolution& solution) {
  const planner::SwingProblem problem(task, solution.elbow_sign);
  const double begin = planner::SwingCurve(solution.x, solution.elbow_sign).begin();
  return static_cast<int>(std::count_if(problem.grid().begin(), problem.grid().end(),
                                        [begin](double t) { return t >= begin; }));
}

/// Mean CPU time [s], which other processes do not change, and the fastest solution.
double solveAll(const std::vector<Start>& starts,
                const std::function<SwingSolution(const Start&)>& solve,
                SwingSolution& best) {
  const std::clock_t begin = std::clock();
  for (const Start& start : starts) {
    const SwingSolution solution = solve(start);
    if (solution.violation < kSolved && solution.release_speed > best.release_speed)
      best = solution;
  }
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC /
         static_cast<double>(starts.size());
}

/// @param plain_density of the plain samples, times as many as the planner has grid points.
SolveCost measure(const SwingTask& task,
                  const std::vector<Start>& starts,
                  int max_evaluations,
                  double plain_density) {
  SwingSolution ours, plain;
  SolveCost cost;
  cost.planner_seconds = solveAll(
      starts,
      [&](const Start& s) { return optimiseSwing(task, s.x, s.elbow_sign, max_evaluations); },
      ours);
  cost.parameters = parametersOf(task);
  cost.samples = samplesOf(task, ours);
  const int plain_samples = static_cast<int>(plain_density * cost.samples);
  cost.differences_seconds = solveAll(
      starts,
      [&](const Start& s) {
        return optimiseDensely(task, s.x, s.elbow_sign, plain_samples, max_evaluations);
      },
      plain);
  cost.planner_speed = ours.release_speed;
  cost.differences_speed = plain.release_speed;
  cost.differences_violation = plain.violation;
  return cost;
}

}  // namespace

SolveCost costOfDefaultThrow() {
  const DefaultSwing swing;
  return measure(swing.task(Shoulder::kHeld), planner::storedStarts(Shoulder::kHeld, 0),
                 swing.config.max_evaluations, kPlainDensity);
}

std::vector<SolveCost> costBySamples() {
  const DefaultSwing swing;
  std::vector<SolveCost> costs;
  for (const double density : {0.5, 1.0, 2.0, 4.0}) {
    SwingTask task = swing.task(Shoulder::kHeld);
    task.grid_density = density;
    costs.push_back(
        measure(task, planner::storedStarts(Shoulder::kHeld, 0), swing.config.max_evaluations, 1));
  }
  return costs;
}

std::vector<SolveCost> costByParameters(planner::Shoulder shoulder) {
  using namespace planner;
  const DefaultSwing swing;
  SwingTask task = swing.task(shoulder);
  SwingSolution solved;
  solveAll(
      storedStarts(shoulder, 0),
      [&](const Start& s) {
        return optimiseSwing(task, s.x, s.elbow_sign, swing.config.max_evaluations);
      },
      solved);
  task.target.p_WTarget.z() += 0.1;
  const std::vector<std::vector<SwingVariable>> fixed{
      {kOmega1, kOmega2, kOmega3, kPhi1, kSwitch2, kPhi3}, {kOmega1, kOmega2, kOmega3}, {}};
  std::vector<SolveCost> costs;
  for (const auto& variables : fixed) {
    task.fixed.reset();
    for (const SwingVariable variable : variables)
      task.fixed.set(variable);
    costs.push_back(measure(task, {{"neighbour", solved.x, solved.elbow_sign}},
                            swing.config.max_evaluations, 1));
  }
  return costs;
}

}  // namespace fastball::bench
