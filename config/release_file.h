#pragma once

#include "config/strict_yaml.h"
#include "model/release_motion.h"

namespace fastball::config {

/// How the hand holds and lets go: keys of the section `hand_server`, which the planner reads as well, so that it predicts what
/// the hand will do. @throw ConfigError
model::ReleaseSettings readRelease(Section& hand_server);

}  // namespace fastball::config
