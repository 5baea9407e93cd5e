#pragma once

#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"

namespace fastball::hand_server {

/// The hand server as a process of the experiment: SWING_PLAN, THROW_START, ARM_STATE, HAND_STATE and ESTOP in; HAND_COMMAND for
/// every HAND_STATE (in real time: for the newest), and RELEASE out. Its HEARTBEAT state is one of idle, planned, armed,
/// running, released, holding (the ball is kept), refused.
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::hand_server
