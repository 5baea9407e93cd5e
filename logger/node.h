#pragma once

#include <memory>
#include <string>

#include "messaging/clock.h"
#include "messaging/lcm_endpoint.h"
#include "messaging/node.h"

namespace fastball::logger {

/// Logs every message of every channel that `endpoint` hears to the file `log_path`, flushed ten times a second, and says
/// LOGGER_STATUS once a second and at the end.
/// @throw std::invalid_argument if the file cannot be written.
std::unique_ptr<messaging::Node> makeNode(messaging::LcmEndpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const std::string& log_path);

}  // namespace fastball::logger
