#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "config/experiment.h"
#include "launch/atlas_setup.h"
#include "launch/commands.h"
#include "messaging/process.h"
#include "planner/atlas_file.h"

namespace fastball::launch {
namespace {

struct AtlasOptions {
  std::string config, cache;
  bool rebuild = false;
};

int makeAtlas(const AtlasOptions& options) {
  const planner::PlannerConfig config = planner::loadConfig(config::experimentPath(options.config));
  const std::filesystem::path folder =
      options.cache.empty() ? planner::atlasFolder() : std::filesystem::path(options.cache);
  Progress progress;
  if (!ensureAtlas(config, folder, options.rebuild, progress))
    return messaging::kExitFailed;
  progress.line("the atlas is at " + planner::atlasPath(config, folder).string());
  return messaging::kExitDone;
}

}  // namespace

void addAtlasCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "atlas", "Plans throws to a grid of targets once, as starts for throws to all others");
  auto options = std::make_shared<AtlasOptions>();
  command->add_option("--config", options->config,
                      "Experiment file (default: config/experiment.yaml)");
  command->add_flag("--rebuild", options->rebuild, "Even if there is one for the configuration");
  command->add_option("--cache", options->cache,
                      "Folder to keep it in (default: fastball in $XDG_CACHE_HOME or in ~/.cache, "
                      "where the planner "
                      "looks for it)");
  command->callback([options, &exit_status] { exit_status = makeAtlas(*options); });
}

}  // namespace fastball::launch
