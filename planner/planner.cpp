#include "planner/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/limit_check.h"
#include "planner/needed_speed.h"
#include "planner/request_check.h"
#include "planner/starts.h"

namespace fastball::planner {
namespace {

// Largest violation of the constraints in a solution that counts, and in one that has been corrected for the aim.
constexpr double kSolved = 1e-4, kCorrected = 1e-3;
constexpr int kAimRounds = 8;
constexpr int kCorrectionEvaluations = 30;
// Solutions tried before giving up.
constexpr std::size_t kCandidates = 3;
// Of the limits, if the grid of 1 ms finds more than the optimiser's samples did.
constexpr double kTightening[] = {1, 0.98, 0.96};
// [m/s per s], what a second of approach is worth.
constexpr double kApproachPrice = 0.1;
// [s], either side of the predicted release: how well the time of an abrupt release is known.
constexpr double kWindow = 1e-3;

std::vector<SwingSolution> solvedOnes(const std::vector<SwingSolution>& solutions) {
  std::vector<SwingSolution> solved;
  std::copy_if(solutions.begin(), solutions.end(), std::back_inserter(solved),
               [](const SwingSolution& s) { return s.violation < kSolved; });
  return solved;
}

/// Phase of a sin base function whose time runs from t0 later.
double shiftedPhase(double phi, double omega, double t0) {
  return std::remainder(phi - omega * t0, 2 * M_PI);
}

}  // namespace

/// A swing whose ball is predicted to land where it shall.
struct Planner::Aimed {
  SwingSolution solution;
  WholeMotion motion;
  ReleasePrediction prediction;
};

Planner::Planner(const PlannerConfig& config, PredictDeparture departure)
    : config_(config),
      arm_(config.arm, config.hand.payload),
      predictor_(config_, arm_, departure ? std::move(departure) : elasticDeparture(config)) {}

SwingTask Planner::taskFor(const ThrowRequest& request) const {
  SwingTask task;
  task.arm = &arm_;
  task.ball = config_.ball;
  task.target = request.target;
  task.p_TBall = config_.hand.p_HBall;
  task.settings = config_.swing;
  task.limit_factor = config_.limit_share;
  return task;
}

std::vector<SwingSolution> Planner::solveAll(const SwingTask& task,
                                             const ThrowRequest& request) const {
  const Eigen::Vector3d& p = request.target.p_WTarget;
  std::vector<SwingSolution> solutions;
  for (const Start& start :
       swingStarts(std::atan2(p.y(), p.x()), config_.random_starts, request.seed)) {
    solutions.push_back(optimiseSwing(task, start.x, start.elbow_sign, config_.max_evaluations));
  }
  return solutions;
}

std::vector<SwingSolution> Planner::solveHarder(const SwingTask& task,
                                                std::vector<SwingSolution> solutions) const {
  std::stable_sort(
      solutions.begin(), solutions.end(),
      [](const SwingSolution& a, const SwingSolution& b) { return a.violation < b.violation; });
  solutions.resize(std::min(solutions.size(), kCandidates));
  for (SwingSolution& solution : solutions) {
    // First into the limits, then to the fastest throw there.
    solution = correctSwing(task, solution, config_.max_evaluations);
    const SwingSolution faster =
        optimiseSwing(task, solution.x, solution.elbow_sign, config_.max_evaluations);
    if (faster.violation < kSolved)
      solution = faster;
  }
  return solutions;
}

void Planner::sortByWorth(std::vector<SwingSolution>& solutions,
                          const ThrowRequest& request) const {
  const auto worth = [&](const SwingSolution& solution) {
    const SwingCurve curve(solution.x, solution.elbow_sign);
    const double approach =
        approachTime(arm_, config_.motion, request.q_arm, curve.at(curve.begin()).q);
    return solution.release_speed - kApproachPrice * approach;
  };
  std::stable_sort(
      solutions.begin(), solutions.end(),
      [&](const SwingSolution& a, const SwingSolution& b) { return worth(a) > worth(b); });
}

std::variant<Planner::Aimed, Refusal> Planner::aim(SwingTask task,
                                                   SwingSolution solution,
                                                   const ThrowRequest& request) const {
  double miss = 0, lead = 0;
  for (int round = 0; round < kAimRounds; ++round) {
    const SwingCurve curve(solution.x, solution.elbow_sign);
    WholeMotion motion =
        wholeMotion(arm_, config_.motion, config_.swing.follow, request.q_arm, curve);
    if (round == 0)
      lead = predictor_.commandTime(motion) - motion.t_zero;
    const double t_command = 1e-3 * std::round(1e3 * (motion.t_zero + lead));
    const auto prediction = predictor_.predict(motion, request.target, t_command);
    if (!prediction)
      return Refusal{"the ball is predicted not to leave the hand for the target"};
    miss = prediction->landing.landing.norm();
    if (miss <= config_.landing_tolerance)
      return Aimed{solution, std::move(motion), *prediction};
    // What the fingers do to the ball hardly depends on the aim: shift it by the miss.
    task.aim -= prediction->landing.landing;
    solution = correctSwing(task, solution, kCorrectionEvaluations);
    if (solution.violation > kCorrected) {
      return Refusal{"the swing aimed so that the ball lands right " +
                     SwingProblem(task, solution.elbow_sign).worstConstraint(solution.x)};
    }
  }
  return Refusal{
      fmt::format("the aim does not settle: after {} rounds the predicted landing is {:.1f} mm off",
                  kAimRounds, 1e3 * miss)};
}

Plan Planner::assemble(const Aimed& aimed, const ThrowRequest& request) const {
  Plan plan;
  plan.strategy = request.strategy;
  plan.trajectory = aimed.motion.trajectory;
  plan.t_ready = aimed.motion.t_ready;
  plan.t_swing = aimed.motion.t_swing;
  plan.t_swing_end = aimed.motion.t_swing_end;
  plan.t_release_command = aimed.prediction.t_command;
  plan.t_release = aimed.prediction.t_departure;
  plan.release_window = {plan.t_release - kWindow, plan.t_release + kWindow};
  plan.residual_acceleration = predictor_.residualAcceleration(
      plan.trajectory, plan.release_window[0], plan.release_window[1]);
  plan.release = aimed.prediction.ball;
  plan.landing = aimed.prediction.landing.landing;
  plan.flight_time = aimed.prediction.landing.time;
  plan.wrist_roll = aimed.prediction.wrist_roll;
  plan.grip_force = config_.release.grip_force;
  SwingVector x = aimed.solution.x;
  x[kPhi1] = shiftedPhase(x[kPhi1], x[kOmega1], aimed.motion.t_zero);
  x[kPhi3] = shiftedPhase(x[kPhi3], x[kOmega3], aimed.motion.t_zero);
  x[kSwitch2] += aimed.motion.t_zero;
  for (int i = 0; i < kSwingVariables; ++i) {
    plan.parameters.emplace_back(swingVariableNames()[i], x[i]);
  }
  plan.parameters.emplace_back("elbow_sign", aimed.solution.elbow_sign);
  return plan;
}

PlanResult Planner::plan(const ThrowRequest& request) const {
  if (auto fault = requestFault(request, config_.arm, config_.hand.p_HBall)) {
    return Refusal{*fault};
  }
  SwingTask task = taskFor(request);
  const std::vector<SwingSolution> solutions = solveAll(task, request);
  std::vector<SwingSolution> candidates = solvedOnes(solutions);
  if (candidates.empty())
    candidates = solvedOnes(solveHarder(task, solutions));
  if (candidates.empty())
    return explain(task, solutions, request);
  sortByWorth(candidates, request);
  candidates.resize(std::min(candidates.size(), kCandidates));
  std::string obstacle;
  for (const SwingSolution& candidate : candidates) {
    for (const double tightening : kTightening) {
      task.limit_factor = tightening * config_.limit_share;
      const SwingSolution solution =
          tightening == 1
              ? candidate
              : optimiseSwing(task, candidate.x, candidate.elbow_sign, config_.max_evaluations);
      const auto aimed = aim(task, solution, request);
      if (const Refusal* refusal = std::get_if<Refusal>(&aimed)) {
        obstacle = refusal->sentence;
        continue;
      }
      const auto& throw_found = std::get<Aimed>(aimed);
      const LimitUse use = checkLimits(arm_, throw_found.motion.trajectory);
      if (!use.violation)
        return assemble(throw_found, request);
      obstacle = *use.violation;
    }
  }
  return Refusal{"no throw found inside all limits: " + obstacle};
}

Refusal Planner::explain(const SwingTask& task,
                         const std::vector<SwingSolution>& solutions,
                         const ThrowRequest& request) const {
  SwingTask free_task = task;
  free_task.must_land = false;
  SwingSolution fastest;
  for (const SwingSolution& solution : solveAll(free_task, request)) {
    if (solution.violation < kSolved && solution.release_speed > fastest.release_speed) {
      fastest = solution;
    }
  }
  const Eigen::Vector3d& p = request.target.p_WTarget;
  const std::string place = fmt::format("({:.3g}, {:.3g}, {:.3g}) m", p.x(), p.y(), p.z());
  const auto needed = neededSpeed(request.target, armReach(config_.arm, config_.hand.p_HBall),
                                  config_.ball.dragPerMetre(), config_.arm.gravity);
  if (!needed) {
    return Refusal{
        fmt::format("the target at {} is out of reach: with its drag, no ball thrown at up to 100 "
                    "m/s gets there",
                    place)};
  }
  if (*needed > fastest.release_speed) {
    const Eigen::Vector4d share =
        SwingCurve(fastest.x, fastest.elbow_sign).at(0).qd.cwiseQuotient(config_.arm.qd_max);
    int joint = 0;
    share.cwiseAbs().maxCoeff(&joint);
    return Refusal{fmt::format(
        "the target at {} is out of reach: {:.1f} m/s or more would be needed, the fastest throw "
        "found leaves at {:.1f} m/s (joint {} is then at {:.0f} % of its {:.4g} rad/s, {})",
        place, *needed, fastest.release_speed, joint + 1, 100 * std::abs(share[joint]),
        config_.arm.qd_max[joint], config_.arm.profile)};
  }
  const auto nearest = std::min_element(
      solutions.begin(), solutions.end(),
      [](const SwingSolution& a, const SwingSolution& b) { return a.violation < b.violation; });
  return Refusal{fmt::format(
      "no throw to {} found inside all limits: the best one, at {:.1f} m/s, {}", place,
      nearest->release_speed, SwingProblem(task, nearest->elbow_sign).worstConstraint(nearest->x))};
}

}  // namespace fastball::planner
