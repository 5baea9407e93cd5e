#include "planner/window_planner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/hand_motion.h"
#include "planner/limit_check.h"
#include "planner/window_side.h"
#include "planner/window_starts.h"

namespace fastball::planner {
namespace {

constexpr int kAimRounds = 8;
// Every stored throw has so many looks before the best few go on; none of them with a cost above
// `kHopeless` comes inside the limits.
constexpr int kFirstLook = 20;
constexpr std::size_t kContenders = 3;
constexpr double kHopeless = 5e3;
// Evaluations of an optimisation from one of those, from one that is nearly right, and from one of the atlas.
constexpr int kFarEvaluations = 130, kNearEvaluations = 30, kAtlasEvaluations = 12;
// Of the limits, kept when a throw must be made a little slower because they were exceeded between the optimiser's samples.
constexpr double kTightened = 0.999;
constexpr double kRangeReserve = 0.01;  // [rad]
// A correction goes that far inside the limits, so that shifting the aim afterwards does not lead out again.
constexpr double kCorrected = 0.997;
// Of a limit, by which a correction may miss that.
constexpr double kNearlyInside = 0.004;
// [m], so far off lands a throw whose aim and departure are interpolated, if its neighbours are alike.
constexpr double kAlikeMiss = 3e-3;
// [m/s^2], acceleration of the free ball relative to the hand from which its direction counts as much as that of the throw.
constexpr double kDriftCounts = 5;
// [m/s^2], below which a window is tried as a free flight.
constexpr double kNearlyFree = 5;

const std::array<const char*, kWindowVariables>& variableNames() {
  static const std::array<const char*, kWindowVariables> names{
      "q1",       "q2",      "q3",      "q4",       "time_to_go", "q3_rate",  "q3_acc",
      "q3_jerk",  "pace_0",  "pace_1",  "run_up_1", "run_up_2",   "run_up_3", "run_up_4",
      "brake_1",  "brake_2", "brake_3", "brake_4",  "before_1",   "before_2", "before_3",
      "before_4", "after_1", "after_2", "after_3",  "after_4"};
  return names;
}

model::ArmParameters cautious(model::ArmParameters arm) {
  arm.position_margin += kRangeReserve;
  return arm;
}

/// Moves `p_WGoal` so that a ball that came through the target's plane `miss` off its centre comes through the centre.
void correctAim(const model::Target& target,
                const Eigen::Vector2d& miss,
                Eigen::Vector3d& p_WGoal) {
  p_WGoal -= miss.x() * target.rightAxis() + miss.y() * target.upAxis();
}

/// The motion through a window in its own time.
SwingMotion swingThrough(const WindowThrow& x, const model::SampledTrajectory& window) {
  SwingMotion swing;
  swing.begin = -kWindowRamp - x.run_up.maxCoeff();
  swing.end = x.window.length + kWindowRamp;
  swing.brake_time = x.brake;
  swing.at = [&](double t) {
    if (t < 0)
      return motionBefore(x, window.samples().front(), t);
    if (t > x.window.length)
      return motionAfter(x, window.samples().back(), t - x.window.length);
    return window.at(std::min(t, window.duration()));
  };
  return swing;
}

}  // namespace

WindowPlanner::WindowPlanner(const PlannerConfig& config,
                             const model::Arm& arm,
                             const ReleasePredictor& predictor)
    : config_(config),
      arm_(arm),
      cautious_arm_(cautious(config.arm), config.hand.payload),
      hand_(config.hand),
      predictor_(predictor) {
  for (const double length : config.robust.window_lengths)
    kinds_.push_back({length, config.robust.limit_share});
}

WindowKind WindowPlanner::kindOf(double length) const {
  const auto kind = std::find_if(kinds_.begin(), kinds_.end(),
                                 [&](const WindowKind& k) { return k.length == length; });
  return kind == kinds_.end() ? WindowKind{length, config_.robust.limit_share} : *kind;
}

WindowProblem WindowPlanner::problemFor(const ThrowRequest& request, const WindowKind& kind) const {
  WindowProblem problem;
  problem.task = {&cautious_arm_, config_.hand.p_HBall, request.target.p_WTarget,
                  config_.ball.dragPerMetre(), config_.arm.gravity};
  problem.hand = &hand_;
  problem.settings = config_.swing;
  problem.n_WTarget = request.target.n_WTarget;
  problem.wanted_speed = config_.robust.wanted_speed;
  problem.errors = config_.robust.errors;
  problem.limit_factor = kind.limit_share;
  problem.length = kind.length;
  return problem;
}

std::optional<WindowSolution> WindowPlanner::solveFrom(const ThrowRequest& request,
                                                       const WindowKind& kind,
                                                       const WindowThrow& start,
                                                       int max_evaluations) const {
  WindowProblem problem = problemFor(request, kind);
  WindowSolution solution = solveWindowThrow(problem, start, max_evaluations);
  if (solution.residual < kNearlyFree) {
    problem.free_flight = true;
    const WindowSolution free = solveWindowThrow(problem, solution.x, max_evaluations);
    if (free.feasible)
      solution = free;
  }
  if (!solution.feasible)
    return {};
  return solution;
}

std::optional<WindowSolution> WindowPlanner::solve(const ThrowRequest& request,
                                                   const WindowKind& kind,
                                                   bool thoroughly) const {
  const Eigen::Vector3d& p = request.target.p_WTarget;
  const WindowProblem problem = problemFor(request, kind);
  std::vector<WindowSolution> contenders;
  for (const WindowThrow& start : windowStarts(std::atan2(p.y(), p.x()), kind.length))
    contenders.push_back(solveWindowThrow(problem, start, kFirstLook));
  std::stable_sort(
      contenders.begin(), contenders.end(),
      [](const WindowSolution& a, const WindowSolution& b) { return a.cost < b.cost; });
  if (!thoroughly)
    contenders.resize(std::min(contenders.size(), kContenders));
  std::optional<WindowSolution> best;
  double best_worth = 0;
  for (const WindowSolution& contender : contenders) {
    if (!thoroughly && contender.cost > kHopeless)
      break;
    const auto solution = solveFrom(request, kind, contender.x, kFarEvaluations);
    if (!solution)
      continue;
    const auto motion = motionOf(problem, request.q_arm, solution->x);
    if (!motion)
      continue;
    const double worth = -solution->cost - kApproachPrice * motion->t_ready;
    if (!best || worth > best_worth) {
      best = solution;
      best_worth = worth;
    }
  }
  return best;
}

std::optional<WholeMotion> WindowPlanner::motionOf(const WindowProblem& problem,
                                                   const std::optional<Eigen::Vector4d>& q_arm,
                                                   const WindowThrow& x) const {
  // The samples of the window are those of the plan.
  const int steps = static_cast<int>(std::lround(x.window.length / config_.motion.sample_time));
  WindowMotion window;
  if (!windowMotion(problem.task, x.window, steps, window))
    return {};
  const model::SampledTrajectory through(x.window.length / steps, window.samples);
  const SwingMotion swing = swingThrough(x, through);
  WholeMotion motion =
      wholeMotion(arm_, config_.motion, q_arm.value_or(swing.at(swing.begin).q), swing);
  motion.window = x.window.length;
  return motion;
}

bool WindowPlanner::landsRight(const ReleasePrediction& prediction) const {
  return prediction.landing.landing.norm() <= config_.landing_tolerance;
}

WristAngles WindowPlanner::wristOf(const WholeMotion& motion) const {
  const Eigen::Vector3d& p_TBall = config_.hand.p_HBall;
  const model::ArmMotion middle = motion.trajectory.at(motion.t_zero + motion.window / 2);
  const Eigen::Vector3d v_W = arm_.pointJacobian(middle.q, p_TBall) * middle.qd;
  const Eigen::Vector3d ahead_W =
      model::flightAcceleration(v_W, config_.ball.dragPerMetre(), config_.arm.gravity) -
      arm_.pointAcceleration(middle.q, middle.qd, middle.qdd, p_TBall);
  const Eigen::Matrix3d R_TW = arm_.X_WT(middle.q).linear().transpose();
  const Eigen::Vector2d v = (R_TW * v_W).head<2>(), ahead = (R_TW * ahead_W).head<2>();
  const Eigen::Vector2d thumb = v.normalized() + ahead / std::max(kDriftCounts, ahead.norm());
  return {std::atan2(-thumb.x(), thumb.y()), 0};
}

std::optional<WindowPlanner::Settled> WindowPlanner::settle(const ThrowRequest& request,
                                                            const WindowKind& kind,
                                                            const WindowThrow& start) const {
  WindowProblem problem = problemFor(request, kind);
  problem.free_flight = start.window.pace.isZero();
  WindowThrow x = start;
  for (int round = 0; round < kAimRounds; ++round) {
    auto motion = motionOf(problem, request.q_arm, x);
    if (!motion)
      return {};
    const auto prediction = predictor_.predict(*motion, wristOf(*motion), request.target,
                                               predictor_.windowCommandTime(*motion));
    if (!prediction)
      return {};
    const Eigen::Vector2d miss = prediction->landing.landing;
    bool slower = false;
    if (miss.norm() <= config_.landing_tolerance) {
      const LimitUse use = checkLimits(arm_, motion->trajectory);
      if (!use.violation)
        return Settled{x, std::move(*motion), *prediction};
      const double excess = std::max(use.speed_ratio, use.torque_ratio);
      if (excess <= 1)
        return {};
      problem.limit_factor *= kTightened / excess;
      slower = true;
    } else {
      // What the fingers do to the ball hardly depends on the aim: shift it by the miss.
      correctAim(request.target, miss, problem.task.p_WGoal);
    }
    WindowSolution aimed = assessWindowThrow(problem, x);
    if (!aimed.feasible || slower)
      aimed = solveWindowThrow(problem, x, kNearEvaluations);
    if (!aimed.feasible)
      return {};
    x = aimed.x;
  }
  return {};
}

std::optional<Plan> WindowPlanner::planNear(const ThrowRequest& request,
                                            const AtlasThrow& start) const {
  const model::Target& target = request.target;
  const AtlasThrow near = start.through(target, config_.arm.gravity);
  WindowProblem problem = problemFor(request, kindOf(near.window));
  WindowThrow x = fromVector(near.x, near.window);
  problem.free_flight = x.window.pace.isZero();
  problem.task.p_WGoal += near.aim;
  HandDeparture departure = near.departure;
  bool departs_alike = near.departs_alike;
  for (int round = 0; round < kAimRounds; ++round) {
    auto motion = motionOf(problem, request.q_arm, x);
    if (!motion)
      return {};
    const WristAngles wrist = wristOf(*motion);
    auto prediction = predictByDeparture(config_, arm_, departure, *motion, wrist, target,
                                         predictor_.windowCommandTime(*motion));
    if (prediction && !landsRight(*prediction)) {
      departs_alike =
          departs_alike && (round > 0 || prediction->landing.landing.norm() < kAlikeMiss);
      correctAim(target, prediction->landing.landing, problem.task.p_WGoal);
      continue;
    }
    if (!prediction)
      return {};
    const WindowSolution now = assessWindowThrow(problem, x);
    double excess = 0;
    if (now.feasible) {
      const LimitUse use = checkLimits(arm_, motion->trajectory);
      if (use.violation) {
        excess = std::max(use.speed_ratio, use.torque_ratio);
      } else if (!departs_alike) {
        // The last word has the integration of this throw's own release.
        prediction =
            predictor_.predict(*motion, wrist, target, predictor_.windowCommandTime(*motion));
        if (!prediction)
          return {};
        departure = seenFromHand(config_, arm_, *motion, *prediction);
        departs_alike = true;
      }
      if (!use.violation && landsRight(*prediction))
        return assemble(request, Settled{x, std::move(*motion), *prediction});
      if (!use.violation)
        continue;
      if (excess <= 1)
        return {};
      problem.limit_factor *= kTightened / excess;
    }
    WindowProblem stricter = problem;
    stricter.limit_factor *= kCorrected;
    const WindowSolution solution = correctWindowThrow(stricter, x, kAtlasEvaluations);
    if (solution.violation > kNearlyInside)
      return {};
    x = solution.x;
  }
  return {};
}

Plan WindowPlanner::assemble(const ThrowRequest& request, const Settled& settled) const {
  const auto& [x, motion, prediction] = settled;
  Plan plan;
  plan.strategy = request.strategy;
  plan.trajectory = motion.trajectory;
  plan.t_ready = motion.t_ready;
  plan.t_swing = motion.t_swing;
  plan.t_swing_end = motion.t_swing_end;
  plan.t_release_command = prediction.t_command;
  plan.t_release = prediction.t_departure;
  plan.release_window = {motion.t_zero, motion.t_zero + x.window.length};
  plan.residual_acceleration = predictor_.residualAcceleration(
      plan.trajectory, prediction.wrist, plan.release_window[0], plan.release_window[1]);
  plan.release = prediction.ball;
  plan.landing = prediction.landing.landing;
  plan.flight_time = prediction.landing.time;
  plan.wrist_roll = prediction.wrist.roll;
  plan.wrist_flexion = prediction.wrist.flexion;
  plan.grip_force = config_.grip_force;
  const WindowVector values = toVector(x);
  for (int i = 0; i < kWindowVariables; ++i)
    plan.parameters.emplace_back(variableNames()[i], values[i]);
  return plan;
}

std::optional<Plan> WindowPlanner::plan(const ThrowRequest& request, bool thoroughly) const {
  for (const WindowKind& kind : kinds_) {
    const std::optional<WindowSolution> solution = solve(request, kind, thoroughly);
    if (!solution)
      continue;
    if (const auto settled = settle(request, kind, solution->x))
      return assemble(request, *settled);
  }
  return {};
}

}  // namespace fastball::planner
