#include "planner/planned_throws.h"

#include <cmath>

#include "planner/limit_check.h"
#include "planner/swing_planner.h"
#include "planner/window_planner.h"
#include "planner/window_starts.h"

namespace fastball::planner {
namespace {

// Evaluations from a stored start, and from the throw of a neighbour.
constexpr int kFirstEvaluations = 150, kNextEvaluations = 40;
// To make a throw better that is inside the limits.
constexpr int kBetterEvaluations = 12;
constexpr int kAimRounds = 5;
constexpr double kAimed = 5e-4, kSwingAimed = 3e-3;  // [m]
// What it costs to be unlike the neighbours, beside what the landing's errors cost.
constexpr double kNearness = 0.01;
// Of the planner's limits, used by a node, so that what is interpolated between nodes keeps them.
constexpr double kNodeShare = 0.995;
// The same for a node that is but a start.
constexpr double kBeyondShare = 1.04;
constexpr double kRingRadius = 0.1;  // [m], no throw depends on it
constexpr double kSolved = 1e-4;     // violation of a swing's constraints

/// What is the same for windows and swings.
class PlannedThrows : public ThrowSource {
 protected:
  PlannedThrows(const PlannerConfig& config, const Eigen::Vector3d& facing)
      : config_(config),
        arm_(config.arm, config.hand.payload),
        predictor_(config, arm_, elasticDeparture(config)),
        facing_(facing) {}

  ThrowRequest requestTo(const Eigen::Vector2d& place) const {
    ThrowRequest request;
    request.target = {{place[0], 0, place[1]}, facing_, kRingRadius};
    return request;
  }

  /// By the departure of the throw or, if it is to be found, by a prediction of its own.
  std::optional<ReleasePrediction> predict(const WholeMotion& motion,
                                           const WristAngles& wrist,
                                           const model::Target& target,
                                           double t_command,
                                           const HandDeparture* departure) const {
    return departure != nullptr
               ? predictByDeparture(config_, arm_, *departure, motion, wrist, target, t_command)
               : predictor_.predict(motion, wrist, target, t_command);
  }

  /// Puts into `entry` what the prediction says.
  void note(const WholeMotion& motion,
            const ReleasePrediction& prediction,
            const model::Target& target,
            Eigen::Vector3d aim,
            double flight_time,
            AtlasThrow& entry) const {
    const Eigen::Vector2d& miss = prediction.landing.landing;
    aim -= miss.x() * target.rightAxis() + miss.y() * target.upAxis();
    entry.v_arrival = prediction.landing.state.v_WBall;
    entry.v_aimed = aimedArrival(motion, prediction.wrist, flight_time);
    entry.aim = aim;
    entry.departure = seenFromHand(config_, arm_, motion, prediction);
    entry.q_ready = motion.trajectory.at(motion.t_swing).q;
    entry.inside = checkLimits(arm_, motion.trajectory).violation ? 0 : 1;
  }

  /// Velocity [m/s] at the target of a ball that leaves at t = 0 of the swing with the hand.
  Eigen::Vector3d aimedArrival(const WholeMotion& motion,
                               const WristAngles& wrist,
                               double flight_time) const {
    const Eigen::Vector3d p_TBall =
        model::Hand(config_.hand).X_TH(wrist.roll, wrist.flexion) * config_.hand.p_HBall;
    const model::ArmMotion at = motion.trajectory.at(motion.t_zero);
    const model::BallState ball{arm_.p_WPoint(at.q, p_TBall),
                                arm_.pointJacobian(at.q, p_TBall) * at.qd};
    return model::fly(ball, flight_time, config_.ball.dragPerMetre(), config_.arm.gravity).v_WBall;
  }

  const PlannerConfig& config_;
  model::Arm arm_;
  ReleasePredictor predictor_;
  Eigen::Vector3d facing_;
};

class Windows : public PlannedThrows {
 public:
  Windows(const PlannerConfig& config,
          const WindowKind& window,
          int family,
          const Eigen::Vector3d& facing)
      : PlannedThrows(config, facing),
        planner_(config, arm_, predictor_),
        window_(window),
        family_(family) {}

  ThrowKind kind() const override { return ThrowKind::kWindow; }

  std::optional<AtlasThrow> first(const Eigen::Vector2d& place) const override {
    AtlasThrow start;
    start.x = toVector(windowStarts(0, window_.length)[family_]);
    start.window = window_.length;
    const auto solution = solveWindowThrow(problemFor(place, start.aim, kNodeShare),
                                           fromVector(start.x, window_.length), kFirstEvaluations);
    if (!solution.feasible)
      return {};
    start.x = toVector(solution.x);
    const auto departed = entryOf(place, start, nullptr);
    if (!departed)
      return {};
    return aimed(place, *departed, kNodeShare);
  }

  std::optional<AtlasThrow> next(const Eigen::Vector2d& place,
                                 const AtlasThrow& near,
                                 bool beyond) const override {
    const double share = beyond ? kBeyondShare : kNodeShare;
    const auto found = aimed(place, near, share);
    if (!found)
      return {};
    const auto better = bettered(place, *found, near.x, share);
    return better ? better : found;
  }

  std::optional<AtlasThrow> smoothed(const Eigen::Vector2d& place,
                                     const AtlasThrow& own,
                                     const AtlasVector& mean) const override {
    return bettered(place, own, mean, own.inside > 0 ? kNodeShare : kBeyondShare);
  }

  std::optional<AtlasThrow> finished(const Eigen::Vector2d& place,
                                     const AtlasThrow& found) const override {
    const auto departed = entryOf(place, found, nullptr);
    if (!departed)
      return {};
    const auto again = aimed(place, *departed, found.inside > 0 ? kNodeShare : kBeyondShare);
    return again ? again : departed;
  }

 private:
  WindowProblem problemFor(const Eigen::Vector2d& place,
                           const Eigen::Vector3d& aim,
                           double share) const {
    WindowProblem problem =
        planner_.problemFor(requestTo(place), {window_.length, share * window_.limit_share});
    problem.task.p_WGoal += aim;
    return problem;
  }

  /// `start` inside the limits and aimed right, its ball departing as it says.
  std::optional<AtlasThrow> aimed(const Eigen::Vector2d& place,
                                  AtlasThrow start,
                                  double share) const {
    for (int round = 0; round < kAimRounds; ++round) {
      const WindowSolution solution =
          correctWindowThrow(problemFor(place, start.aim, share),
                             fromVector(start.x, window_.length), kNextEvaluations);
      if (!solution.feasible)
        return {};
      start.x = toVector(solution.x);
      start.cost = solution.cost;
      const Eigen::Vector3d aim = start.aim;
      const auto entry = entryOf(place, start, &start.departure);
      if (!entry)
        return {};
      start = *entry;
      if ((start.aim - aim).norm() < kAimed)
        return start;
    }
    return {};
  }

  /// A throw whose landing errors move less, but not far from `near`.
  std::optional<AtlasThrow> bettered(const Eigen::Vector2d& place,
                                     AtlasThrow start,
                                     const AtlasVector& near,
                                     double share) const {
    WindowProblem problem = problemFor(place, start.aim, share);
    problem.near = near;
    problem.nearness = kNearness;
    const WindowSolution solution =
        solveWindowThrow(problem, fromVector(start.x, window_.length), kBetterEvaluations);
    if (!solution.feasible)
      return {};
    start.x = toVector(solution.x);
    return aimed(place, start, share);
  }

  /// With the departure given, or its own.
  std::optional<AtlasThrow> entryOf(const Eigen::Vector2d& place,
                                    const AtlasThrow& found,
                                    const HandDeparture* departure) const {
    const model::Target target = requestTo(place).target;
    const auto motion =
        planner_.motionOf(problemFor(place, found.aim, 1), {}, fromVector(found.x, window_.length));
    if (!motion)
      return {};
    const auto prediction = predict(*motion, planner_.wristOf(*motion), target,
                                    predictor_.windowCommandTime(*motion), departure);
    if (!prediction)
      return {};
    AtlasThrow entry = found;
    note(*motion, *prediction, target, found.aim, found.x[kTimeToGo], entry);
    return entry;
  }

  WindowPlanner planner_;
  WindowKind window_;
  int family_;
};

class Swings : public PlannedThrows {
 public:
  /// @param steepness as SwingTask has it.
  Swings(const PlannerConfig& config,
         Shoulder shoulder,
         SwingGoal goal,
         int family,
         const Eigen::Vector3d& facing,
         double steepness)
      : PlannedThrows(config, facing),
        planner_(config, arm_, predictor_),
        shoulder_(shoulder),
        goal_(goal),
        family_(family),
        steepness_(steepness) {}

  ThrowKind kind() const override {
    if (goal_ == SwingGoal::kShortestFlight)
      return ThrowKind::kFlatSwing;
    return shoulder_ == Shoulder::kFree ? ThrowKind::kFreeSwing : ThrowKind::kHeldSwing;
  }

  std::optional<AtlasThrow> first(const Eigen::Vector2d& place) const override {
    const Start start = storedStarts(shoulder_, 0)[family_];
    AtlasThrow near;
    near.x = start.x;
    near.elbow_sign = start.elbow_sign;
    return settled(place, near, kNodeShare);
  }

  std::optional<AtlasThrow> next(const Eigen::Vector2d& place,
                                 const AtlasThrow& near,
                                 bool beyond) const override {
    return settled(place, near, beyond ? kBeyondShare : kNodeShare);
  }

  std::optional<AtlasThrow> smoothed(const Eigen::Vector2d&,
                                     const AtlasThrow&,
                                     const AtlasVector&) const override {
    return {};  // the optimiser ends at the optimum, which is smooth
  }

  std::optional<AtlasThrow> finished(const Eigen::Vector2d&,
                                     const AtlasThrow& found) const override {
    return found;  // it is: its departure is its own
  }

 private:
  /// Solved and aimed anew until the aim stands still.
  std::optional<AtlasThrow> settled(const Eigen::Vector2d& place,
                                    AtlasThrow start,
                                    double share) const {
    for (int round = 0; round < kAimRounds; ++round) {
      const Eigen::Vector3d aim = start.aim;
      auto found = solved(place, start, share);
      if (!found || (found->aim - aim).norm() < kSwingAimed)
        return found;
      start = *found;
    }
    return {};
  }

  std::optional<AtlasThrow> solved(const Eigen::Vector2d& place,
                                   const AtlasThrow& near,
                                   double share) const {
    const ThrowRequest request = requestTo(place);
    SwingTask task = planner_.taskFor(request, shoulder_, goal_);
    task.limit_factor *= share;
    task.steepness = steepness_;
    task.aim = {near.aim.dot(request.target.rightAxis()), near.aim.dot(request.target.upAxis())};
    const SwingSolution solution =
        optimiseSwing(task, near.x, near.elbow_sign, config_.max_evaluations);
    if (!(solution.violation < kSolved))
      return {};
    const WholeMotion motion = planner_.motionOf(solution, {});
    const double t_command = predictor_.commandTime(motion);
    const WristAngles wrist{solution.x[kWristRoll], solution.x[kWristFlexion]};
    const auto prediction = predict(motion, wrist, request.target, t_command, nullptr);
    if (!prediction)
      return {};
    AtlasThrow entry;
    entry.x = solution.x;
    entry.elbow_sign = solution.elbow_sign;
    entry.lead = 1e-3 * std::round(1e3 * (t_command - motion.t_zero));
    entry.cost = goal_ == SwingGoal::kFastest ? -solution.release_speed
                                              : kFlightWorth * solution.x[kFlightTime];
    note(motion, *prediction, request.target, near.aim, solution.x[kFlightTime], entry);
    return entry;
  }

  SwingPlanner planner_;
  Shoulder shoulder_;
  SwingGoal goal_;
  int family_;
  double steepness_;
};

}  // namespace

std::unique_ptr<ThrowSource> windowThrows(const PlannerConfig& config,
                                          const WindowKind& window,
                                          int family,
                                          const Eigen::Vector3d& facing) {
  return std::make_unique<Windows>(config, window, family, facing);
}

std::unique_ptr<ThrowSource> swingThrows(const PlannerConfig& config,
                                         Shoulder shoulder,
                                         SwingGoal goal,
                                         int family,
                                         const Eigen::Vector3d& facing,
                                         double steepness) {
  return std::make_unique<Swings>(config, shoulder, goal, family, facing, steepness);
}

}  // namespace fastball::planner
