#pragma once

#include <memory>

#include "messaging/node.h"
#include "messaging/process.h"

namespace fastball::vision_tracker {

/// The tracker as a process of the experiment: CAMERA_INFO, CAMERA_LEFT, CAMERA_RIGHT and PLAN_REQUEST (for the target) in;
/// BALL_OBSERVATION for every image, BALL_TRACK and LANDING out. Before the first PLAN_REQUEST, and before both cameras'
/// CAMERA_INFO, images are dropped. Its HEARTBEAT names the request as plan_id; its state is one of idle (no request yet),
/// waiting, tracking, landed.
/// @throw config::ConfigError
std::unique_ptr<messaging::Node> makeNode(messaging::Endpoint& endpoint,
                                          const messaging::Clock& clock,
                                          const messaging::ProcessOptions& options);

}  // namespace fastball::vision_tracker
