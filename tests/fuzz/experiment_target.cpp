// What `fastball run` makes of the messages of its processes.
#include <nlohmann/json.hpp>

#include "config/experiment.h"
#include "launch/experiment_node.h"
#include "launch/judge.h"
#include "launch/results.h"
#include "launch/silence_watch.h"
#include "launch/throw_record.h"
#include "tests/fuzz/node_target.h"

namespace fastball {
namespace {

launch::RunSettings readSettings() {
  const config::Experiment experiment = config::loadExperiment(fuzz::experimentPath());
  launch::RunSettings settings;
  settings.throws = 3;
  settings.config = launch::loadRunConfig(fuzz::experimentPath());
  settings.strategy = settings.config.strategy;
  settings.q_rest = experiment.q_rest;
  settings.target = experiment.target;
  return settings;
}

/// The experiment and everybody else who listens in its process.
class Conductor : public messaging::Node {
 public:
  Conductor(messaging::Endpoint& endpoint,
            const messaging::Clock& clock,
            const launch::RunSettings& settings)
      : roster_(endpoint),
        silence_(endpoint, clock),
        judge_(endpoint),
        experiment_(endpoint, clock, roster_, settings) {
    launch::recordThrows(endpoint, throws_);
  }
  std::string name() const override { return experiment_.name(); }
  void step() override {
    experiment_.step();
    if (const std::string silent = silence_.silentFor(30, {"planner", "sim_bullet"});
        !silent.empty() && !experiment_.finished())
      experiment_.stop(silent);
    experiment_.progress();
    if (experiment_.finished())
      sayResult();
  }
  int64_t wakeUs() const override { return experiment_.wakeUs(); }
  messaging::NodeState state() const override { return experiment_.state(); }
  bool finished() const override { return experiment_.finished(); }

 private:
  void sayResult() {
    launch::RunResult result;
    for (const launch::Throw& seen : experiment_.throws()) {
      result.throws.push_back(launch::judge(seen, judge_.of(seen.scene_id), 0.1));
      launch::throwLine(result.throws.back());
    }
    result.error = experiment_.error();
    launch::writeJson(launch::toJson(result), "/dev/null");
  }

  std::map<int64_t, launch::ThrowRecord> throws_;
  launch::Roster roster_;
  launch::SilenceWatch silence_;
  launch::Judge judge_;
  launch::ExperimentNode experiment_;
};

}  // namespace
}  // namespace fastball

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const launch::RunSettings kSettings = readSettings();
  static fuzz::NodeTarget target("experiment", 500, [](auto& endpoint, const auto& clock) {
    return std::make_unique<Conductor>(endpoint, clock, kSettings);
  });
  target.hear(data, size);
  return 0;
}
