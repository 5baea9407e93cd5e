#include <boost/container_hash/hash.hpp>
#include <optional>

#include "config/experiment.h"
#include "planner/aimed_plan.h"
#include "planner/node.h"
#include "planner/planner.h"
#include "planner/request_check.h"
#include "tests/fuzz/node_target.h"

namespace fastball {
namespace {

/// Plans, with a fraction of the effort, for one in so many requests that can be planned for: under the sanitizers a plan takes a
/// thousand times as long as all that is done with a message. What the request says decides, so an input does the same again.
constexpr std::size_t kPlannedOneIn = 50;

planner::PlannerConfig hastyConfig() {
  planner::PlannerConfig config = planner::loadConfig(fuzz::experimentPath());
  config.max_evaluations = 5;
  config.random_starts = 1;
  return config;
}

std::size_t hashOf(const planner::ThrowRequest& request) {
  std::size_t hash = 0;
  boost::hash_combine(hash, request.strategy);
  boost::hash_combine(hash, request.seed);
  const auto add = [&hash](const auto& vector) {
    boost::hash_range(hash, vector.data(), vector.data() + vector.size());
  };
  add(request.q_arm);
  add(request.target.p_WTarget);
  add(request.target.n_WTarget);
  add(request.biases);
  return hash;
}

/// Every request is checked; those that are not planned for are answered with the plan of the experiment's own throw.
class SparingPlanner {
 public:
  SparingPlanner() : config_(planner::loadConfig(fuzz::experimentPath())) {
    const config::Experiment experiment = config::loadExperiment(fuzz::experimentPath());
    plan_ = planner::Planner(config_).plan(
        {"paper", experiment.q_rest, experiment.target, 1, model::LandingBiases::Zero()});
    if (!std::holds_alternative<planner::Plan>(*plan_))
      fuzz::die("there is no plan for the experiment's own throw");
  }
  planner::PlanResult answer(const planner::ThrowRequest& request) const {
    if (const auto fault = planner::requestFault(request, config_))
      return planner::Refusal{*fault};
    if (hashOf(request) % kPlannedOneIn == 0)
      return planner::planAimed(hasty_, request);
    return *plan_;
  }

 private:
  planner::PlannerConfig config_;
  planner::Planner hasty_{hastyConfig()};
  std::optional<planner::PlanResult> plan_;
};

}  // namespace
}  // namespace fastball

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const SparingPlanner planner;
  static fuzz::NodeTarget target("planner", 10000, [](auto& endpoint, const auto& clock) {
    return planner::makeAnsweringNode(
        endpoint, clock, [](const planner::ThrowRequest& r) { return planner.answer(r); });
  });
  target.hear(data, size);
  return 0;
}
