#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planner/atlas.h"
#include "planner/config.h"

namespace fastball::planner {

/// Where atlases are kept: fastball/ in $XDG_CACHE_HOME, else in ~/.cache; empty if there is no such place.
std::filesystem::path atlasFolder();

/// The file of a configuration's atlas, named by the arm's profile and a hash of all that it
/// depends on: arm and limits, hand, ball, the planner's settings, the version of the format.
std::filesystem::path atlasPath(const PlannerConfig& config, const std::filesystem::path& folder);

/// What was found at the place of an atlas.
struct FoundAtlas {
  std::optional<Atlas> atlas;
  std::string fault;  ///< one sentence if there is a file that is no atlas for the configuration
};
/// Neither atlas nor fault if there is no file at `path`.
FoundAtlas loadAtlas(const PlannerConfig& config, const std::filesystem::path& path);

/// Writes the file whole or not at all: others that read or write it meanwhile see the old one or the new one. The
/// same atlas makes the same bytes.
/// @throw std::runtime_error with one sentence if the file cannot be written.
void saveAtlas(const PlannerConfig& config, const Atlas& atlas, const std::filesystem::path& path);

}  // namespace fastball::planner
