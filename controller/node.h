#pragma once

#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"

namespace fastball::controller {

/// The controller as a process of the experiment: SWING_PLAN, THROW_START, ARM_STATE and ESTOP in; ARM_COMMAND for
/// every ARM_STATE (in real time: for the newest), and CONTROLLER_STATUS out. Its HEARTBEAT state is one of idle,
/// planned, armed, running, holding, braked, refused.
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::controller
