#pragma once

#include <memory>
#include <string>

#include "logger/recorder.h"
#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/node.h"

namespace fastball::logger {

struct LoggerOptions {
  RecorderOptions recorder;
  std::string channels = ".*";  ///< regular expression that a logged channel matches as a whole
  std::string excluded;         ///< and that it must not match; empty: none
};

/// Logs every message that `endpoint` hears on the channels asked for (but for LCM's test of
/// itself), and says LOGGER_STATUS once a second and at the end. What it received is on its way to
/// the disk within 100 ms. When the log is not whole, it says so once, when that begins and when it
/// ends, and at the end adds to the run's record what was written, and what was dropped and when.
/// Its state is one of logging, waiting (the disk takes nothing, messages wait in memory),
/// dropping.
/// @throw std::invalid_argument if the file cannot be written or a regular expression does not parse.
std::unique_ptr<messaging::Node> makeNode(messaging::LcmEndpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const LoggerOptions& options);

}  // namespace fastball::logger
