#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lcmtypes/fastball_types.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {

struct ReplayOptions {
  double speed = 1;       ///< times real time
  bool commands = false;  ///< also channels that make a robot move
};

/// Says the messages of a log again, at their recorded intervals divided by the speed. Channels that make a robot move
/// (ARM_COMMAND, HAND_COMMAND, THROW_START, SCENE) are passed over unless asked for.
/// @return how many messages were said.
/// @throw std::invalid_argument if the log cannot be read.
int64_t replayLog(const std::string& log_path,
                  const ReplayOptions& options,
                  messaging::LcmEndpoint& endpoint);

/// A recorded LANDING beside what the tracker says now.
struct RerunLanding {
  landing_t recorded{};
  landing_t rerun{};
  bool equal = false;  ///< every field but seq, bit for bit
};

/// Feeds the recorded images, camera data and requests of a log to a fresh tracker process, as fast as it takes them, and pairs
/// each recorded LANDING with the one it says.
/// @throw std::invalid_argument if the log cannot be read or holds no LANDING.
/// @throw std::runtime_error if the tracker does not start, ends, or falls silent.
std::vector<RerunLanding> rerunTracker(const std::string& log_path, const std::string& config_path);

/// "throw 1: recorded (+12.10, -3.00) mm, now (+12.10, -3.00) mm: equal"
std::string rerunLine(const RerunLanding& landing);

}  // namespace fastball::launch
