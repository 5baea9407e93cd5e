#include "bench/robust_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "config/arm_file.h"
#include "config/experiment.h"
#include "planner/planner.h"

namespace fastball::bench {
namespace {

constexpr double kWindow = 0.04;  // [s]
constexpr double kStep = 0.001;   // [s]
constexpr double kMilli = 1e3;

/// A plan for the default target, with what it was made for.
struct Thrown {
  planner::PlannerConfig config;
  model::Target target;
  planner::Plan plan;
};

Thrown defaultThrow(const std::string& strategy, const std::string& arm) {
  const std::string path = config::defaultExperimentPath();
  const config::Experiment experiment = config::loadExperiment(path);
  Thrown thrown{planner::loadConfig(path), experiment.target, {}};
  if (!arm.empty())
    thrown.config.arm = config::readArm(config::Section::fromFile(
        std::filesystem::path(path).parent_path() / "arm" / (arm + ".yaml")));
  const planner::Planner planner(thrown.config);
  const planner::PlanResult result =
      planner.plan({strategy, experiment.q_rest, experiment.target, 1});
  if (const auto* refusal = std::get_if<planner::Refusal>(&result))
    throw std::runtime_error(refusal->sentence);
  thrown.plan = std::get<planner::Plan>(result);
  return thrown;
}

/// A ball that leaves the hand t [s] after the command, with its velocity.
model::BallState leaving(const Thrown& thrown, const model::Arm& arm, double t) {
  const planner::Plan& plan = thrown.plan;
  const model::Hand hand(thrown.config.hand);
  const Eigen::Vector3d p_TBall =
      hand.X_TH(plan.wrist_roll, plan.wrist_flexion) * thrown.config.hand.p_HBall;
  const model::ArmMotion motion = plan.trajectory.at(plan.t_release_command + t);
  return {arm.p_WPoint(motion.q, p_TBall), arm.pointJacobian(motion.q, p_TBall) * motion.qd};
}

/// Largest distance [mm] between the landing of a ball that leaves at the command and of one that leaves within kWindow.
double windowShift(const Thrown& thrown) {
  const model::Arm arm(thrown.config.arm, thrown.config.hand.payload);
  const auto landing = [&](double t) {
    return model::land(leaving(thrown, arm, t), thrown.target, thrown.config.ball.dragPerMetre(),
                       thrown.config.arm.gravity)
        .value()
        .landing;
  };
  double largest = 0;
  for (double t = 0; t <= kWindow + kStep / 2; t += kStep)
    largest = std::max(largest, (landing(t) - landing(0)).norm());
  return kMilli * largest;
}

Row shiftRow() {
  const Thrown robust = defaultThrow("robust", ""), paper = defaultThrow("paper", "");
  const model::Arm arm(robust.config.arm, robust.config.hand.payload);
  return {"plan.robust.window_shift_mm",
          windowShift(robust),
          "mm",
          "strategy paper",
          windowShift(paper),
          fmt::format("of the landing, a ball that leaves freely within 40 ms of the command; {}, "
                      "hand at {:.2f} m/s",
                      robust.config.arm.profile, leaving(robust, arm, 0).v_WBall.norm())};
}

Row residualRow(const std::string& id, const std::string& profile) {
  const Thrown robust = defaultThrow("robust", profile), paper = defaultThrow("paper", profile);
  return {id,
          robust.plan.residual_acceleration,
          "m/s^2",
          "strategy paper, 2 ms",
          paper.plan.residual_acceleration,
          fmt::format("hand minus free ball, largest in the release window of {:.0f} ms; {}",
                      kMilli * (robust.plan.release_window[1] - robust.plan.release_window[0]),
                      profile)};
}

}  // namespace

std::vector<Benchmark> robustBenchmarks() {
  const char* const residual = "plan.robust.residual_acceleration";
  const char* const residual_90v = "plan.robust.residual_acceleration_90v";
  return {{"plan.robust.window_shift_mm", shiftRow},
          {residual, [=] { return residualRow(residual, "wam4-48v"); }},
          {residual_90v, [=] { return residualRow(residual_90v, "wam4-90v"); }}};
}

}  // namespace fastball::bench
