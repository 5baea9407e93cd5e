#include "bench/reach_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>

#include "bench/ceiling.h"
#include "config/experiment.h"
#include "planner/atlas_builder.h"
#include "planner/planner.h"

namespace fastball::bench {
namespace {

constexpr int kAtlasTargets = 1000, kColdTargets = 60;
constexpr int64_t kSeed = 1;
constexpr double kMilli = 1e3;

struct Setup {
  config::Experiment experiment = config::loadExperiment(config::defaultExperimentPath());
  planner::PlannerConfig config = planner::loadConfig(config::defaultExperimentPath());
};

/// 2 to 4 m away, 60 degrees to either side, 0.8 m below to 0.8 m above the shoulder, the ring
/// facing the robot within 45 degrees.
std::vector<model::Target> randomTargets(int count) {
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<model::Target> targets(count);
  for (model::Target& target : targets) {
    const double distance = uniform(2, 4), azimuth = uniform(-M_PI / 3, M_PI / 3);
    const double facing = azimuth + uniform(-M_PI / 4, M_PI / 4);
    target.p_WTarget = {distance * std::cos(azimuth), distance * std::sin(azimuth),
                        uniform(-0.8, 0.8)};
    target.n_WTarget = {-std::cos(facing), -std::sin(facing), 0};
    target.radius = 0.1;
  }
  return targets;
}

/// Planning times [ms], of the processor, of the targets solved, and the others.
struct Planned {
  std::vector<double> ms;
  std::vector<model::Target> refused;
};

Planned planAll(const Setup& setup, const planner::Planner& planner, int count) {
  Planned planned;
  for (const model::Target& target : randomTargets(count)) {
    const std::clock_t start = std::clock();
    const planner::PlanResult result =
        planner.plan({"robust", setup.experiment.q_rest, target, kSeed});
    const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (std::holds_alternative<planner::Plan>(result))
      planned.ms.push_back(kMilli * taken);
    else
      planned.refused.push_back(target);
  }
  std::sort(planned.ms.begin(), planned.ms.end());
  return planned;
}

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty())
    throw std::runtime_error("no target was solved");
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

Row timeRow(const std::string& id, const Planned& planned, double share, const std::string& note) {
  return {id,
          quantile(planned.ms, share),
          "ms",
          "slowest",
          planned.ms.back(),
          fmt::format("{}, {} random targets solved of {}, CPU time of one core", note,
                      planned.ms.size(), planned.ms.size() + planned.refused.size())};
}

Row coverage(const Setup& setup, const Planned& planned) {
  CeilingOptions options;
  int reached = 0;
  for (const model::Target& target : planned.refused)
    reached += reachable(setup.config, target, options) ? 1 : 0;
  const double solved = static_cast<double>(planned.ms.size());
  return {"plan.coverage",
          solved / (solved + reached),
          "1",
          "targets that the planner or the free-form optimiser reaches",
          solved + reached,
          fmt::format("strategy robust from the atlas, {} random targets", kAtlasTargets)};
}

/// Speed [m/s] of the ball in the hand when it leaves.
double handSpeed(const planner::Planner& planner, const planner::Plan& plan) {
  const model::Hand hand(planner.config().hand);
  const Eigen::Vector3d p_TBall =
      hand.X_TH(plan.wrist_roll, plan.wrist_flexion) * planner.config().hand.p_HBall;
  const model::ArmMotion motion = plan.trajectory.at(plan.t_release);
  return (planner.arm().pointJacobian(motion.q, p_TBall) * motion.qd).norm();
}

double plannedSpeed(const Setup& setup, const planner::PredictDeparture& departure) {
  const planner::Planner planner(setup.config, departure);
  const planner::PlanResult result =
      planner.plan({"paper", setup.experiment.q_rest, setup.experiment.target, kSeed});
  if (const auto* refusal = std::get_if<planner::Refusal>(&result))
    throw std::runtime_error(refusal->sentence);
  return handSpeed(planner, std::get<planner::Plan>(result));
}

Row speedShare(const std::string& id, planner::Shoulder shoulder) {
  Setup setup;
  setup.config.swing.shoulder = shoulder;
  setup.config.shoulders = {shoulder};
  // A ball that leaves as freely as the ceiling's.
  const double speed = plannedSpeed(setup, planner::instantDeparture(setup.config)),
               by_fingers = plannedSpeed(setup, planner::elasticDeparture(setup.config));
  CeilingOptions options;
  options.hold_shoulder = shoulder == planner::Shoulder::kHeld;
  const Ceiling most = ceiling(setup.config, setup.experiment.target, options);
  if (!most.found)
    throw std::runtime_error("the free-form optimiser found no throw to the default target");
  return {
      id,
      speed / most.release_speed,
      "1",
      "ceiling",
      1.0,
      fmt::format("{:.2f} m/s of a ball that leaves the hand freely; free-form optimum {:.2f} m/s; "
                  "hand at {:.2f} m/s if the fingers let go as they do; {}",
                  speed, most.release_speed, by_fingers, setup.config.arm.profile)};
}

}  // namespace

std::vector<Benchmark> reachBenchmarks() {
  // Measured when the first row asks for them.
  const auto setup = std::make_shared<Setup>();
  const auto atlas = std::make_shared<std::shared_ptr<Planned>>();
  const auto from_atlas = [=]() -> const Planned& {
    if (!*atlas) {
      const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
      const planner::Planner planner(
          setup->config, {},
          std::make_shared<planner::Atlas>(planner::buildAtlas(setup->config, threads)));
      *atlas = std::make_shared<Planned>(planAll(*setup, planner, kAtlasTargets));
    }
    return **atlas;
  };
  const auto without = std::make_shared<std::shared_ptr<Planned>>();
  const auto cold = [=]() -> const Planned& {
    if (!*without)
      *without =
          std::make_shared<Planned>(planAll(*setup, planner::Planner(setup->config), kColdTargets));
    return **without;
  };
  const std::string warm_note = "strategy robust, from the atlas",
                    cold_note = "strategy robust, without an atlas";
  return {
      {"plan.paper.speed_share",
       [] { return speedShare("plan.paper.speed_share", planner::Shoulder::kHeld); }},
      {"plan.free.speed_share",
       [] { return speedShare("plan.free.speed_share", planner::Shoulder::kFree); }},
      {"plan.atlas.p50_ms",
       [=] { return timeRow("plan.atlas.p50_ms", from_atlas(), 0.5, warm_note); }},
      {"plan.atlas.p99_ms",
       [=] { return timeRow("plan.atlas.p99_ms", from_atlas(), 0.99, warm_note); }},
      {"plan.cold.p50_ms", [=] { return timeRow("plan.cold.p50_ms", cold(), 0.5, cold_note); }},
      {"plan.cold.p99_ms", [=] { return timeRow("plan.cold.p99_ms", cold(), 0.99, cold_note); }},
      {"plan.coverage", [=] { return coverage(*setup, from_atlas()); }}};
}

}  // namespace fastball::bench
