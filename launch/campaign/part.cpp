#include "launch/campaign/part.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/experiment.h"
#include "launch/local_run.h"
#include "messaging/stop_signals.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;
constexpr const char* kInterrupted = "interrupted";
constexpr int kMostFaults = 10;  // of units of a part, before it gives up

ThrowOutcome outcomeOf(const JudgedThrow& judged, double ball_radius, double target_radius) {
  ThrowOutcome outcome;
  outcome.hit = judged.hit;
  outcome.landing = judged.truth.landing;
  outcome.clean = outcome.landing && outcome.landing->norm() + ball_radius < target_radius;
  if (judged.seen.measured)
    outcome.measured = judged.seen.landing;
  outcome.release_speed = judged.truth.release_speed.value_or(0);
  outcome.note = judged.seen.note;
  return outcome;
}

}  // namespace

UnitResult runUnit(const Campaign& campaign, const Unit& unit) {
  const Case& one = campaign.cases.at(static_cast<std::size_t>(unit.case_index));
  RunOptions options;
  options.throws = unit.throws;
  options.seed = campaign.seed + unit.set_up;
  options.strategy = one.strategy;
  options.config = one.config;
  options.uncertainty = one.uncertainty;
  options.no_network = true;
  options.no_images = !campaign.images;
  const auto begun = std::chrono::steady_clock::now();
  RunSetup setup = prepareRun(options);
  setup.options.one_thread = true;  // the other cores have parts of their own
  const double ball_radius = config::loadExperiment(setup.options.config).ball.radius;
  RunResult run;
  Progress silent(true);
  runInOneProcess(setup, silent, run);
  const bool refused = run.error.find("refused") != std::string::npos;
  if (!run.error.empty() && !refused)
    throw std::runtime_error(
        fmt::format("{}, set-up {} (seed {}): {}", one.name, unit.set_up, options.seed, run.error));
  UnitResult result;
  result.unit = unit;
  for (const JudgedThrow& judged : run.throws)
    result.throws.push_back(outcomeOf(judged, ball_radius, setup.settings.target.radius));
  while (static_cast<int>(result.throws.size()) < unit.throws) {
    result.throws.emplace_back();
    result.throws.back().note = run.error;
  }
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

bool runPart(const std::string& folder, const std::string& todo, int part, int parts) {
  const Campaign campaign = readCampaign(folder);
  const std::vector<Unit> units = unitsOf(campaign);
  std::ifstream list(todo);
  if (!list)
    throw std::invalid_argument(fmt::format("{}: there is no such file", todo));
  RecordFile record(folder, fmt::format("{}-{}", fs::path(todo).stem().string(), part));
  const messaging::StopSignals signals;
  std::size_t number = 0;
  std::string fault;
  int faults = 0;
  for (int i = 0; list >> number; ++i) {
    if (i % parts != part)
      continue;
    UnitResult result;
    try {
      result = runUnit(campaign, units.at(number));
    } catch (const std::runtime_error& e) {
      if (signals.received() || std::string(e.what()).find(kInterrupted) != std::string::npos)
        return false;
      // It shall not take the units after it along, unless none can be done.
      fault = e.what();
      if (++faults == kMostFaults)
        break;
      continue;
    }
    record.add(result);
    if (signals.received())
      return false;
  }
  if (!fault.empty())
    throw std::runtime_error(fault);
  return true;
}

std::string writeTodo(const std::string& folder, const Campaign& campaign) {
  const std::map<Unit, UnitResult> done = readRecord(folder);
  const std::vector<Unit> units = unitsOf(campaign);
  std::string numbers;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (done.count(units[i]) == 0)
      numbers += fmt::format("{}\n", i);
  }
  if (numbers.empty())
    return {};
  fs::path path;
  for (int attempt = 1; path.empty() || fs::exists(path); ++attempt)
    path = fs::path(folder) / fmt::format("attempt-{}.todo", attempt);
  std::ofstream(path) << numbers;
  return path.string();
}

}  // namespace fastball::launch
