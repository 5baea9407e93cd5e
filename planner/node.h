#pragma once

#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"

namespace fastball::planner {

/// The planner as a process of the experiment: PLAN_REQUEST in, SWING_PLAN out. A repeated request gets its answer again. Its
/// HEARTBEAT state is "planning" or "idle"; a refusal is its detail. It plans from the atlas of its configuration, if there is one in
/// atlasFolder().
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::planner
