#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/ceiling.h"
#include "bench/ceiling_words.h"
#include "config/experiment.h"
#include "launch/results.h"
#include "messaging/process.h"
#include "messaging/version.h"

namespace {

using fastball::bench::Ceiling;
using fastball::bench::CeilingOptions;
using fastball::model::Target;

struct Arguments {
  std::string config, json;
  std::vector<std::array<double, 3>> targets;
  CeilingOptions options;
  bool any_direction = false, reachable = false, budget = false;
};

/// A ring like the experiment's, that faces the shoulder's axis.
Target targetAt(const std::array<double, 3>& p, double radius) {
  Target target;
  target.p_WTarget = {p[0], p[1], p[2]};
  const double distance = std::hypot(p[0], p[1]);
  if (!(distance > 0) || !std::isfinite(distance) || !std::isfinite(p[2])) {
    throw std::invalid_argument(
        fmt::format("--target {} {} {}: a target is finite and off the shoulder's axis, so that it "
                    "has a side that faces the arm",
                    p[0], p[1], p[2]));
  }
  target.n_WTarget = {-p[0] / distance, -p[1] / distance, 0};
  target.radius = radius;
  return target;
}

void addOptions(CLI::App& app, Arguments& arguments) {
  CeilingOptions& options = arguments.options;
  app.add_option("--config", arguments.config, "Experiment file; default: the experiment's");
  app.add_option("--target", arguments.targets,
                 "Centre of the ring [m], facing the arm; may be given again for another; default: "
                 "the experiment's")
      ->type_name("X Y Z");
  app.add_flag("--hold-shoulder", options.hold_shoulder, "Joint 2 stands still");
  app.add_flag("--across-forearm", options.across_forearm,
               "The ball leaves across the forearm, Eq. (25)");
  app.add_flag("--any-direction", arguments.any_direction, "Fastest throw wherever the ball goes");
  app.add_flag("--reachable", arguments.reachable,
               "Only whether there is a throw: the first found");
  app.add_flag("--budget", arguments.budget, "With 10, 20 ... 100 % of the torque limits");
  app.add_option("--torque-share", options.torque_share, "Of the torque limits")
      ->capture_default_str();
  app.add_option("--speed-share", options.speed_share, "Of the speed limits")
      ->capture_default_str();
  app.add_option("--control-points", options.control_points, "Of each joint's curve")
      ->capture_default_str();
  app.add_option("--starts", options.starts, "Optimisations at most")->capture_default_str();
  app.add_flag("--all-starts", options.all_starts, "Also after one has come to the bound");
  app.add_option("--seed", options.seed, "Of the random poses")->capture_default_str();
  app.add_option("--json", arguments.json, "File for the results as one JSON object");
}

/// Prints a line for each throw. @return whether there was one for every question.
bool answer(const Arguments& arguments,
            const fastball::planner::PlannerConfig& config,
            const Target& target,
            nlohmann::json& results) {
  using Clock = std::chrono::steady_clock;
  CeilingOptions options = arguments.options;
  options.must_land = !arguments.any_direction;
  std::vector<double> shares{options.torque_share};
  const auto begin = Clock::now();
  std::vector<Ceiling> ceilings;
  if (arguments.budget) {
    shares = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
    ceilings = ceilingOverTorqueBudget(config, target, options, shares);
  } else if (arguments.reachable) {
    ceilings = {anyThrow(config, target, options)};
  } else {
    ceilings = {ceiling(config, target, options)};
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  bool all = true;
  for (std::size_t i = 0; i < ceilings.size(); ++i) {
    options.torque_share = shares[i];
    fmt::print("{}\n", ceilingLine(ceilings[i], target, options));
    results.push_back(ceilingJson(ceilings[i], target, options));
    all = all && ceilings[i].found;
  }
  fmt::print(stderr, "{:.3f} s\n", seconds);
  return all;
}

int run(int argc, char** argv) {
  CLI::App app{"How fast the arm can throw at all: free-form motions under its limits.",
               "fastball-ceiling"};
  app.set_version_flag("--version",
                       std::string("fastball-ceiling ") + fastball::messaging::version());
  Arguments arguments;
  addOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? fastball::messaging::kExitDone : fastball::messaging::kExitUsage;
  }
  const std::string path = fastball::config::experimentPath(arguments.config);
  const fastball::planner::PlannerConfig config = fastball::planner::loadConfig(path);
  const Target own = fastball::config::loadExperiment(path).target;
  std::vector<Target> targets;
  for (const auto& p : arguments.targets)
    targets.push_back(targetAt(p, own.radius));
  if (targets.empty())
    targets.push_back(own);
  nlohmann::json results = nlohmann::json::array();
  bool all = true;
  for (const Target& target : targets)
    all = answer(arguments, config, target, results) && all;
  if (!arguments.json.empty()) {
    fastball::launch::writeJson({{"arm", config.arm.profile}, {"throws", results}}, arguments.json);
  }
  return all ? fastball::messaging::kExitDone : fastball::messaging::kExitFailed;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "fastball-ceiling: {}\n", e.what());
    return fastball::messaging::kExitUsage;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fastball-ceiling: {}\n", e.what());
    return fastball::messaging::kExitFailed;
  }
}
