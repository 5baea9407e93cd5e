#pragma once

#include <functional>
#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"
#include "planner/plan.h"

namespace fastball::planner {

/// The planner as a process of the experiment: PLAN_REQUEST in, SWING_PLAN out. A repeated request gets its answer
/// again. Its HEARTBEAT state is "planning" or "idle"; a refusal is its detail. It plans from the atlas of its
/// configuration, if there is one in atlasFolder().
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

/// What is answered to a request.
using AnswerRequest = std::function<PlanResult(const ThrowRequest&)>;

/// The same with answers of another's making.
std::unique_ptr<messaging::Node> makeAnsweringNode(messaging::Endpoint& endpoint,
                                                   const messaging::Clock& clock,
                                                   AnswerRequest answer);

}  // namespace fastball::planner
