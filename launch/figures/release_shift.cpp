#include "launch/figures/release_shift.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <stdexcept>

#include "launch/figures/printed_rolling.h"
#include "launch/figures/rolling_range.h"
#include "model/ball_flight.h"
#include "planner/hand_motion.h"

namespace fastball::launch {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 1e-5;     // [s], in which Eq. (24) is looked for
constexpr double kAbout = 0.04;    // [s], and how far from the planned command
constexpr double kLongest = 0.08;  // [s], on the fingers

model::RollingTask taskFrom(double t, const PlannedRelease& release) {
  model::RollingTask task;
  task.t_start = t;
  task.t_end = t + kLongest;
  task.gravity = release.experiment.arm.gravity;
  task.fingertip = release.fingertip;
  return task;
}

/// The ball as it comes off; nothing if it does not.
std::optional<model::BallState> leaving(const PlannedRelease& release, LetGo how, double error) {
  const model::BallParameters& ball = release.experiment.ball;
  const model::FingerFrameMotion frame =
      model::fingerFrameMotion(release.fingers, release.hand_at(error));
  const auto on = [&](const Vector3d& r_F, const Vector3d& v_F) {
    return model::BallState{frame.X_WF * r_F, model::releaseVelocity(frame, r_F, v_F)};
  };
  const auto off = [](const model::RollingMotion& motion) {
    return motion.released ? std::optional(motion.ball) : std::nullopt;
  };
  switch (how) {
    case LetGo::kFreely:
      return on(Vector3d::Zero(), Vector3d::Zero());
    case LetGo::kRolling:
      return off(rigidRoll(release, error, false));
    case LetGo::kPrinted:
      return off(rollAsPrinted(ball, release.fingers, release.hand_at, taskFrom(error, release)));
    case LetGo::kElastic: {
      const model::Departure departure = model::predictDeparture(
          ball, model::Hand(release.experiment.hand), release.command,
          [&](double t) { return release.hand_at(error + t); }, release.experiment.arm.gravity);
      return departure.departed ? std::optional(departure.ball) : std::nullopt;
    }
    case LetGo::kGently: {
      const model::RollingTask task = taskFrom(error, release);
      return off(model::elasticOnFingers(
          ball, release.fingers, release.hand_at,
          model::settledStart(ball, release.fingers, release.hand_at, task), task));
    }
    case LetGo::kLongerOnFingers: {
      const model::FingerFrameMotion start =
          model::fingerFrameMotion(release.fingers, release.hand_at(0));
      const Vector3d g_F =
          start.X_WF.linear().transpose() * Vector3d(0, 0, -release.experiment.arm.gravity);
      const double ddx = 5.0 / 7 * (-start.a_F.x() + g_F.x());
      return on({ddx * error * error / 2, 0, 0}, {ddx * error, 0, 0});
    }
  }
  return {};
}

}  // namespace

PlannedRelease plannedRelease(const config::Experiment& experiment,
                              const planner::PlannerConfig& config,
                              const planner::Plan& plan) {
  PlannedRelease release;
  release.experiment = experiment;
  release.command.grip_force = config.grip_force;
  release.command.settings = config.release;
  release.fingers = model::fingersBehind(experiment.hand, experiment.ball.radius);
  release.fingertip = fingertipPastBall(experiment.hand, experiment.ball.radius);
  const auto at_plan_time = [arm = model::Arm(experiment.arm, experiment.hand.payload),
                             hand = model::Hand(experiment.hand),
                             wrist = planner::WristAngles{plan.wrist_roll, plan.wrist_flexion},
                             trajectory = plan.trajectory](double t) {
    return planner::handMotion(arm, hand, wrist, trajectory.at(t));
  };
  const auto push = [&](double t) {
    const model::FingerFrameMotion frame =
        model::fingerFrameMotion(release.fingers, at_plan_time(t));
    const Vector3d g_W(0, 0, -experiment.arm.gravity);
    return frame.a_F.y() - (frame.X_WF.linear().transpose() * g_W).y();
  };
  // From the end backwards: the hand must not push again afterwards.
  double t = plan.t_release_command + kAbout;
  while (t > plan.t_release_command - kAbout && push(t) <= 0)
    t -= kStep;
  if (push(plan.t_release_command + kAbout) > 0 || push(t) <= 0) {
    throw std::runtime_error(
        fmt::format("Eq. (24) does not come true within {} s of the planned release", kAbout));
  }
  release.t_plan = t;
  release.hand_at = [at_plan_time, t](double since) { return at_plan_time(t + since); };
  return release;
}

Eigen::Vector2d landing(const PlannedRelease& release, LetGo how, double error) {
  const std::optional<model::BallState> ball = leaving(release, how, error);
  const std::optional<model::Landing> landing =
      ball ? model::land(*ball, release.experiment.target, release.experiment.ball.dragPerMetre(),
                         release.experiment.arm.gravity)
           : std::nullopt;
  if (!landing) {
    throw std::runtime_error(fmt::format(
        "a ball let go {:+.1f} ms off the planned moment does not come to the target's plane",
        1e3 * error));
  }
  return landing->landing;
}

model::RollingMotion rigidRoll(const PlannedRelease& release, double error, bool endless) {
  model::RollingTask task = taskFrom(error, release);
  if (endless)
    task.fingertip = std::numeric_limits<double>::infinity();
  return rollOnFingers(release.experiment.ball, release.fingers, release.hand_at, task);
}

Eigen::Vector2d landingShift(const PlannedRelease& release,
                             LetGo how,
                             const std::vector<double>& errors) {
  double mean = 0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> landings;
  for (const double error : errors) {
    landings.push_back(landing(release, how, error));
    mean += error / static_cast<double>(errors.size());
    middle += landings.back() / static_cast<double>(errors.size());
  }
  double squares = 0;
  Eigen::Vector2d products = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += (errors[i] - mean) * (errors[i] - mean);
    products += (errors[i] - mean) * (landings[i] - middle);
  }
  if (!(squares > 0))
    throw std::invalid_argument("a shift of the landing needs two different errors");
  return products / squares;
}

}  // namespace fastball::launch
