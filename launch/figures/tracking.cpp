#include "launch/figures/tracking.h"

#include <fmt/format.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "launch/local_run.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

/// The experiment file with another law of the controller, while this object lives.
class ExperimentWithLaw {
 public:
  ExperimentWithLaw(const std::string& config, const std::string& law) {
    std::string name = (fs::temp_directory_path() / "fastball-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error(fmt::format("cannot make a folder '{}'", name));
    folder_ = name;
    YAML::Node experiment = YAML::LoadFile(config);
    experiment["controller"]["law"] = law;
    for (const char* const file : {"arm", "hand", "ball"})
      experiment[file] =
          (fs::absolute(config).parent_path() / experiment[file].as<std::string>()).string();
    std::ofstream(path()) << experiment;
  }
  ~ExperimentWithLaw() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  ExperimentWithLaw(const ExperimentWithLaw&) = delete;
  ExperimentWithLaw& operator=(const ExperimentWithLaw&) = delete;
  std::string path() const { return (folder_ / "experiment.yaml").string(); }

 private:
  fs::path folder_;
};

model::SampledTrajectory trajectoryOf(const swing_plan_t& plan) {
  using Row = Eigen::Map<const Eigen::Vector4d>;
  std::vector<model::ArmMotion> samples;
  for (int k = 0; k < plan.n_samples; ++k)
    samples.push_back({Row(plan.q[k].data()), Row(plan.qd[k].data()), Row(plan.qdd[k].data())});
  return {plan.dt, std::move(samples)};
}

}  // namespace

TrackedThrow trackedThrow(const std::string& config, const std::string& law) {
  const ExperimentWithLaw experiment(config, law);
  RunOptions options;
  options.throws = 1;
  options.no_network = true;
  options.strategy = "paper";
  options.config = experiment.path();
  const RunSetup setup = prepareRun(options);
  TrackedThrow tracked;
  RunResult result;
  Progress progress(true);
  runInOneProcess(setup, progress, result, [&](messaging::Endpoint& endpoint) {
    endpoint.subscribe<swing_plan_t>(messaging::kSwingPlan,
                                     [&](const auto& m) { tracked.plan = m; });
    endpoint.subscribe<throw_start_t>(messaging::kThrowStart,
                                      [&](const auto& m) { tracked.start_utime = m.start_utime; });
    endpoint.subscribe<arm_state_t>(messaging::kArmState, [&](const auto& m) {
      if (tracked.states.empty() || m.tick > tracked.states.back().tick)  // a state said again
        tracked.states.push_back(m);
    });
  });
  if (!result.error.empty())
    throw std::runtime_error(result.error);
  tracked.planned = trajectoryOf(tracked.plan);
  return tracked;
}

}  // namespace fastball::launch
