#include "launch/run_setup.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/experiment.h"
#include "controller/config.h"
#include "hand_server/config.h"
#include "launch/systems/system_file.h"
#include "planner/config.h"
#include "sim_bullet/node.h"
#include "vision_tracker/config.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

/// Reads the section of every process, so that a bad file is refused before anything is started.
void checkProcessSections(const messaging::ProcessOptions& options) {
  planner::loadConfig(options.config);
  controller::loadConfig(options.config);
  hand_server::loadConfig(options.config);
  sim_bullet::loadSetup(options);
  vision_tracker::readTracker(options.config);
}

std::string defaultLogPath(int64_t seed) {
  const std::tm now = fmt::localtime(std::time(nullptr));
  return fmt::format("runs/{:%Y%m%d-%H%M%S}-seed{}.lcmlog", now, seed);
}

std::string absolutePath(const std::string& path) {
  return path.empty() ? path : fs::absolute(path).lexically_normal().string();
}

void requireReadable(const std::string& flag, const std::string& path) {
  if (!std::ifstream(path)) {
    throw std::invalid_argument(fmt::format("{} {}: there is no such file", flag, path));
  }
}

}  // namespace

void requireWritable(const std::string& flag, const std::string& path) {
  std::error_code error;
  const bool existed = fs::exists(path, error);
  const bool writable = std::ofstream(path, std::ios::app).good();
  if (!existed && writable)
    fs::remove(path, error);
  if (!writable) {
    throw std::invalid_argument(fmt::format("{} {}: no file can be written there", flag, path));
  }
}

RunSetup prepareRun(const RunOptions& options) {
  RunSetup setup;
  setup.options.config = absolutePath(config::experimentPath(options.config));
  setup.on_system = !options.system.empty();
  setup.options.lcm_url = options.lcm_url;
  if (setup.on_system) {
    const System system = loadSystem(options.system);
    setup.options.lcm_url = system.lcm_url;
    setup.options.silence_limit = system.silence_limit;
    setup.clock_limit = system.clock_limit;
    setup.options.images = system.has("vision_tracker");
  } else {
    setup.options.images = !options.no_images;
  }
  setup.options.realtime = options.realtime;
  setup.command_line = options.command_line;
  setup.options.uncertainty = absolutePath(options.uncertainty);
  setup.options.key = absolutePath(options.key);
  setup.key = messaging::keyOf(setup.options.key);

  const config::Experiment experiment = config::loadExperiment(setup.options.config);
  setup.arm = experiment.arm.profile;
  setup.settings.throws = options.throws;
  setup.settings.learned = absolutePath(options.learned);
  setup.settings.ball = experiment.ball;
  setup.settings.gravity = experiment.arm.gravity;
  setup.settings.images = setup.options.images;
  setup.settings.seed = options.seed;
  setup.settings.q_rest = experiment.q_rest;
  setup.settings.target = experiment.target;
  setup.settings.config = loadRunConfig(setup.options.config);
  setup.settings.strategy =
      options.strategy.empty() ? setup.settings.config.strategy : options.strategy;
  if (!options.uncertainty.empty())
    requireReadable("--uncertainty", options.uncertainty);
  checkProcessSections(setup.options);

  if (!options.learned.empty())
    requireWritable("--learned", options.learned);
  if (!options.json.empty())
    requireWritable("--json", options.json);
  if (!options.no_network && !setup.on_system) {
    setup.log = options.log.empty() ? defaultLogPath(options.seed) : options.log;
    if (options.log.empty())
      fs::create_directories("runs");
    requireWritable("--log", setup.log);
  }
  return setup;
}

}  // namespace fastball::launch
