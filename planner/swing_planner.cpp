#include "planner/swing_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/limit_check.h"

namespace fastball::planner {
namespace {

// Largest violation of the constraints in a solution that counts, and in one that has been corrected for the aim.
constexpr double kSolved = 1e-4, kCorrected = 1e-3;
constexpr int kAimRounds = 8;
// Evaluations of a correction, and of one of a throw that is nearly right.
constexpr int kCorrectionEvaluations = 30, kAtlasEvaluations = 6;
// Of the limits, kept when they were exceeded between the optimiser's samples.
constexpr double kTightened = 0.9995;
// [m], so far off lands a throw whose aim and departure are interpolated, if its neighbours are alike.
constexpr double kAlikeMiss = 3e-3;
// Solutions tried before giving up.
constexpr std::size_t kCandidates = 3;
// Of the limits, if checkLimits() finds more than the optimiser's samples did.
constexpr double kTightening[] = {1, 0.98, 0.96};
// [s], either side of the predicted release: how well the time of an abrupt release is known.
constexpr double kWindow = 1e-3;

std::vector<SwingSolution> solvedOnes(const std::vector<SwingSolution>& solutions) {
  std::vector<SwingSolution> solved;
  std::copy_if(solutions.begin(), solutions.end(), std::back_inserter(solved),
               [](const SwingSolution& s) { return s.violation < kSolved; });
  return solved;
}

double worthOf(const SwingSolution& solution, SwingGoal goal) {
  return goal == SwingGoal::kFastest ? solution.release_speed
                                     : -kFlightWorth * solution.x[kFlightTime];
}

double azimuthOf(const model::Target& target) {
  return std::atan2(target.p_WTarget.y(), target.p_WTarget.x());
}

/// Sine of the angle at which the ball comes through the ring.
double steepness(const ReleasePrediction& prediction, const model::Target& target) {
  return -target.n_WTarget.dot(prediction.landing.state.v_WBall.normalized());
}

/// Phase of a sin base function whose time runs from t0 later.
double shiftedPhase(double phi, double omega, double t0) {
  return std::remainder(phi - omega * t0, 2 * M_PI);
}

}  // namespace

SwingPlanner::SwingPlanner(const PlannerConfig& config,
                           const model::Arm& arm,
                           const ReleasePredictor& predictor)
    : config_(config), arm_(arm), predictor_(predictor), hand_(config.hand) {}

SwingTask swingTask(const PlannerConfig& config,
                    const model::Arm& arm,
                    const model::Hand& hand,
                    const model::Target& target,
                    Shoulder shoulder) {
  SwingTask task;
  task.arm = &arm;
  task.hand = &hand;
  task.ball = config.ball;
  task.target = target;
  task.settings = config.swing;
  task.settings.shoulder = shoulder;
  task.limit_factor = config.limit_share;
  return task;
}

SwingTask SwingPlanner::taskFor(const ThrowRequest& request,
                                Shoulder shoulder,
                                SwingGoal goal) const {
  SwingTask task = swingTask(config_, arm_, hand_, request.target, shoulder);
  task.goal = goal;
  return task;
}

WholeMotion SwingPlanner::motionOf(const SwingSolution& solution,
                                   const std::optional<Eigen::Vector4d>& q_arm) const {
  const SwingCurve curve(solution.x, solution.elbow_sign);
  return wholeMotion(arm_, config_.motion, config_.swing.follow,
                     q_arm.value_or(curve.at(curve.begin()).q), curve);
}

std::vector<SwingSolution> SwingPlanner::solveAll(const SwingTask& task,
                                                  const std::vector<Start>& starts) const {
  std::vector<SwingSolution> solutions;
  double fastest = 0;
  for (const Start& start : starts) {
    solutions.push_back(
        optimiseSwing(task, start.x, start.elbow_sign, config_.max_evaluations, fastest));
    if (task.goal == SwingGoal::kFastest && solutions.back().violation < kSolved)
      fastest = std::max(fastest, solutions.back().release_speed);
  }
  return solutions;
}

std::vector<SwingSolution> SwingPlanner::search(const SwingTask& task,
                                                const ThrowRequest& request,
                                                bool thoroughly) const {
  const Shoulder shoulder = task.settings.shoulder;
  const double azimuth = azimuthOf(request.target);
  std::vector<SwingSolution> solutions = solveAll(task, storedStarts(shoulder, azimuth));
  if (!thoroughly || !solvedOnes(solutions).empty())
    return solutions;
  const std::vector<SwingSolution> more =
      solveAll(task, randomStarts(shoulder, azimuth, config_.random_starts, request.seed));
  solutions.insert(solutions.end(), more.begin(), more.end());
  if (!solvedOnes(solutions).empty())
    return solutions;
  return solveHarder(task, solutions);
}

std::vector<SwingSolution> SwingPlanner::solveHarder(const SwingTask& task,
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

void SwingPlanner::sortByWorth(SwingGoal goal,
                               std::vector<SwingSolution>& solutions,
                               const ThrowRequest& request) const {
  const auto worth = [&](const SwingSolution& solution) {
    const SwingCurve curve(solution.x, solution.elbow_sign);
    const double approach =
        approachTime(arm_, config_.motion, request.q_arm, curve.at(curve.begin()).q);
    return worthOf(solution, goal) - kApproachPrice * approach;
  };
  std::stable_sort(
      solutions.begin(), solutions.end(),
      [&](const SwingSolution& a, const SwingSolution& b) { return worth(a) > worth(b); });
}

std::variant<SwingPlanner::Aimed, Refusal> SwingPlanner::aim(SwingTask task,
                                                             SwingSolution solution,
                                                             const ThrowRequest& request) const {
  double miss = 0, lead = 0;
  for (int round = 0; round < kAimRounds; ++round) {
    WholeMotion motion = motionOf(solution, request.q_arm);
    if (round == 0)
      lead = predictor_.commandTime(motion) - motion.t_zero;
    const double t_command = 1e-3 * std::round(1e3 * (motion.t_zero + lead));
    const auto prediction = predictor_.predict(motion, request.target, t_command);
    if (!prediction)
      return Refusal{
          "the ball is predicted not to leave the hand for the target, or to be touched again by "
          "it"};
    miss = prediction->landing.landing.norm();
    if (miss <= config_.landing_tolerance)
      return Aimed{solution, std::move(motion), *prediction};
    // What the fingers do to the ball hardly depends on the aim: shift it by the miss, and the steepness likewise.
    task.aim -= prediction->landing.landing;
    if (round == 0)
      task.steepness += SwingTask().steepness - steepness(*prediction, request.target);
    solution = correctSwing(task, solution, kCorrectionEvaluations);
    // The first shift is so large that the nearest throw is not nearly the fastest.
    if (round == 0) {
      const SwingSolution faster =
          optimiseSwing(task, solution.x, solution.elbow_sign, config_.max_evaluations);
      if (faster.violation < kSolved)
        solution = faster;
    }
    if (solution.violation > kCorrected) {
      return Refusal{"the swing aimed so that the ball lands right " +
                     SwingProblem(task, solution.elbow_sign).worstConstraint(solution.x)};
    }
  }
  return Refusal{
      fmt::format("the aim does not settle: after {} rounds the predicted landing is {:.1f} mm off",
                  kAimRounds, 1e3 * miss)};
}

std::variant<SwingPlanner::Aimed, Refusal> SwingPlanner::realise(
    SwingTask task,
    std::vector<SwingSolution> candidates,
    const ThrowRequest& request) const {
  sortByWorth(task.goal, candidates, request);
  candidates.resize(std::min(candidates.size(), kCandidates));
  std::string obstacle;
  for (const SwingSolution& candidate : candidates) {
    for (const double tightening : kTightening) {
      task.limit_factor = tightening * config_.limit_share;
      const SwingSolution solution =
          tightening == 1
              ? candidate
              : optimiseSwing(task, candidate.x, candidate.elbow_sign, config_.max_evaluations);
      auto aimed = aim(task, solution, request);
      if (const Refusal* refusal = std::get_if<Refusal>(&aimed)) {
        obstacle = refusal->sentence;
        continue;
      }
      const Aimed& found = std::get<Aimed>(aimed);
      const double steep = steepness(found.prediction, request.target);
      if (steep < kLeastSteepness) {
        obstacle = fmt::format(
            "the ball meets the ring's plane at {:.0f} degrees, which must be {:.0f} or more",
            std::asin(steep) * 180 / M_PI, std::asin(kLeastSteepness) * 180 / M_PI);
        break;
      }
      const LimitUse use = checkLimits(arm_, found.motion.trajectory);
      if (!use.violation)
        return aimed;
      obstacle = *use.violation;
    }
  }
  return Refusal{"no throw found inside all limits: " + obstacle};
}

SwingSolution SwingPlanner::fastest(const ThrowRequest& request, Shoulder shoulder) const {
  SwingTask task = taskFor(request, shoulder);
  task.must_land = false;
  SwingSolution fastest;
  for (const SwingSolution& solution :
       solveAll(task, storedStarts(shoulder, azimuthOf(request.target)))) {
    if (solution.violation < kSolved && solution.release_speed > fastest.release_speed)
      fastest = solution;
  }
  return fastest;
}

PlanResult SwingPlanner::plan(const ThrowRequest& request,
                              const std::vector<Shoulder>& shoulders,
                              SwingGoal goal) const {
  Refusal refusal;
  for (const Shoulder shoulder : shoulders) {
    const SwingTask task = taskFor(request, shoulder, goal);
    const std::vector<SwingSolution> solutions =
        search(task, request, shoulder == shoulders.back());
    const std::vector<SwingSolution> candidates = solvedOnes(solutions);
    if (candidates.empty()) {
      const auto nearest = std::min_element(
          solutions.begin(), solutions.end(),
          [](const SwingSolution& a, const SwingSolution& b) { return a.violation < b.violation; });
      refusal.sentence =
          fmt::format("the best throw found, at {:.1f} m/s, {}", nearest->release_speed,
                      SwingProblem(task, nearest->elbow_sign).worstConstraint(nearest->x));
      continue;
    }
    const auto aimed = realise(task, candidates, request);
    if (const Aimed* throw_found = std::get_if<Aimed>(&aimed))
      return assemble(*throw_found, request);
    refusal = std::get<Refusal>(aimed);
  }
  return refusal;
}

std::optional<Plan> SwingPlanner::planNear(const ThrowRequest& request,
                                           const AtlasThrow& start,
                                           Shoulder shoulder,
                                           SwingGoal goal) const {
  const model::Target& target = request.target;
  const AtlasThrow near = start.through(target, config_.arm.gravity);
  SwingTask task = taskFor(request, shoulder, goal);
  task.aim = {near.aim.dot(target.rightAxis()), near.aim.dot(target.upAxis())};
  SwingSolution solution;
  solution.x = near.x;
  solution.elbow_sign = near.elbow_sign;
  HandDeparture departure = near.departure;
  bool departs_alike = near.departs_alike;
  for (int round = 0; round < kAimRounds; ++round) {
    solution = correctSwing(task, solution, kAtlasEvaluations);
    if (solution.violation > kCorrected)
      return {};
    WholeMotion motion = motionOf(solution, request.q_arm);
    const double t_command = 1e-3 * std::round(1e3 * (motion.t_zero + near.lead));
    const WristAngles wrist{solution.x[kWristRoll], solution.x[kWristFlexion]};
    auto prediction =
        predictByDeparture(config_, arm_, departure, motion, wrist, target, t_command);
    if (prediction && !departs_alike &&
        prediction->landing.landing.norm() <= config_.landing_tolerance) {
      // The last word has the integration of this throw's own release.
      prediction = predictor_.predict(motion, wrist, target, t_command);
      if (prediction)
        departure = seenFromHand(config_, arm_, motion, *prediction);
      departs_alike = true;
    }
    if (!prediction)
      return {};
    const Eigen::Vector2d miss = prediction->landing.landing;
    if (miss.norm() > config_.landing_tolerance) {
      departs_alike = departs_alike && (round > 0 || miss.norm() < kAlikeMiss);
      task.aim -= miss;
      continue;
    }
    if (steepness(*prediction, target) < kLeastSteepness)
      return {};
    const LimitUse use = checkLimits(arm_, motion.trajectory);
    if (!use.violation)
      return assemble({solution, std::move(motion), *prediction}, request);
    const double excess = std::max(use.speed_ratio, use.torque_ratio);
    if (excess <= 1)
      return {};
    task.limit_factor *= kTightened / excess;
  }
  return {};
}

Plan SwingPlanner::assemble(const Aimed& aimed, const ThrowRequest& request) const {
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
      plan.trajectory, aimed.prediction.wrist, plan.release_window[0], plan.release_window[1]);
  plan.release = aimed.prediction.ball;
  plan.landing = aimed.prediction.landing.landing;
  plan.flight_time = aimed.prediction.landing.time;
  plan.wrist_roll = aimed.prediction.wrist.roll;
  plan.wrist_flexion = aimed.prediction.wrist.flexion;
  plan.grip_force = config_.grip_force;
  SwingVector x = aimed.solution.x;
  x[kPhi1] = shiftedPhase(x[kPhi1], x[kOmega1], aimed.motion.t_zero);
  x[kPhi3] = shiftedPhase(x[kPhi3], x[kOmega3], aimed.motion.t_zero);
  x[kPhiGamma] = shiftedPhase(x[kPhiGamma], x[kOmegaGamma], aimed.motion.t_zero);
  x[kSwitch2] += aimed.motion.t_zero;
  for (int i = 0; i < kSwingVariables; ++i) {
    plan.parameters.emplace_back(swingVariableNames()[i], x[i]);
  }
  plan.parameters.emplace_back("elbow_sign", aimed.solution.elbow_sign);
  return plan;
}

}  // namespace fastball::planner
