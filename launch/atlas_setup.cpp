#include "launch/atlas_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>

#include "launch/run_setup.h"
#include "planner/atlas_builder.h"
#include "planner/atlas_file.h"
#include "planner/request_check.h"

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kBarLength = 30;
constexpr double kFirstGuess = 0.03;  // share of the work from which on the time left is told

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string bar(double share, double seconds) {
  const int full = static_cast<int>(std::lround(kBarLength * share));
  std::string text =
      fmt::format("atlas [{:#<{}}{:<{}}] {:3.0f} %", "", full, "", kBarLength - full, 100 * share);
  if (share > kFirstGuess)
    text += fmt::format(", {:.0f} s left", std::ceil(seconds * (1 - share) / share));
  return text;
}

planner::Atlas build(const planner::PlannerConfig& config, Progress& progress) {
  const auto start = Clock::now();
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return planner::buildAtlas(config, threads, [&](double share) {
    const double seconds = secondsSince(start);
    progress.status(bar(share, seconds), static_cast<int64_t>(1e6 * seconds));
  });
}

/// Why nothing can be written to the folder, or nothing.
std::string obstacle(const fs::path& path) {
  if (path.parent_path().empty())
    return "neither XDG_CACHE_HOME nor HOME says where";
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  try {
    requireWritable(path.parent_path().string(), path.string() + ".new");
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

}  // namespace

bool ensureAtlas(const planner::PlannerConfig& config,
                 const fs::path& folder,
                 bool rebuild,
                 Progress& progress) {
  const fs::path path = folder.empty() ? fs::path() : planner::atlasPath(config, folder);
  const planner::FoundAtlas found = planner::loadAtlas(config, path);
  if (found.atlas && !rebuild)
    return true;
  if (!found.fault.empty())
    progress.line(found.fault + "; it is made anew");
  if (planner::configFault(config))
    return false;  // the planner will say why nothing can be planned
  if (const std::string why = obstacle(path); !why.empty()) {
    progress.line("no atlas of throws can be kept, each throw is planned from the start: " + why);
    return false;
  }
  progress.line(fmt::format("making the atlas of throws for {} (once for each configuration)",
                            config.arm.profile));
  const auto start = Clock::now();
  const planner::Atlas atlas = build(config, progress);
  try {
    planner::saveAtlas(config, atlas, path);
  } catch (const std::runtime_error& e) {
    progress.line(fmt::format("the atlas of throws is lost: {}", e.what()));
    return false;
  }
  progress.line(
      fmt::format("atlas of {} throws made in {:.1f} s", atlas.throws(), secondsSince(start)));
  return true;
}

}  // namespace fastball::launch
